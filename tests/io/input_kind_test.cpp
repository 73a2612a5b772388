#include "io/input_kind.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "any_hdf5.h"
#include "core/error.h"
#include "core/output_file.h"
#include "core/temporary_folder.h"
#include "hdf5/hdf5_file.h"
#include "io/png_file.h"
#include "io/stroke_file.h"
#include "test_folder.h"

namespace sandstroke {
namespace {

using testing::AllOf;
using testing::EndsWith;
using testing::HasSubstr;
using testing::StartsWith;

class InputKinds : public testing::Test {
 protected:
  std::filesystem::path text(const std::string& content, const std::string& name = "file.toml") const {
    put_text(folder_ / name, content);
    return folder_ / name;
  }
  InputKind kind_of_text(const std::string& content) const { return kind_of(text(content)); }
  InputKind kind_of_format(const std::string& format) const {
    Hdf5Writer file(folder_ / "file.h5", any_hdf5);
    file.attribute("/", "format", format);
    file.finish();
    return kind_of(folder_ / "file.h5");
  }
  const TemporaryFolder folder_;
};

TEST_F(InputKinds, AreKnownByContent) {
  EXPECT_EQ(kind_of_text("[relaxation]\nrate = 60\n"), InputKind::scene);
  EXPECT_EQ(kind_of_text("[stroke]\nfile = 'a.h5'\n"), InputKind::scene);
  EXPECT_EQ(kind_of_text("[sweep]\nscene = 'a.toml'\n"), InputKind::plan);
  EXPECT_EQ(kind_of_text("force = 2.0\n[[segment]]\nkind = 'move'\n"), InputKind::script);
  EXPECT_EQ(kind_of_format("sandstroke.run"), InputKind::run);
  EXPECT_EQ(kind_of_format("sandstroke.golden"), InputKind::golden);
  EXPECT_EQ(kind_of_format("sandstroke.sweep"), InputKind::sweep);
  EXPECT_EQ(kind_of_format("sandstroke.point"), InputKind::point);
  EXPECT_EQ(kind_of_format("sandstroke.bench"), InputKind::bench);
  EXPECT_EQ(kind_of(text("", "hand.h5.recording")), InputKind::recording);

  Stroke stroke;
  stroke.time = {0.0};
  stroke.position = {{0, 0, 0}};
  write_stroke_file(folder_ / "a.h5", stroke);
  std::filesystem::rename(folder_ / "a.h5", folder_ / "named.toml");
  EXPECT_EQ(kind_of(folder_ / "named.toml"), InputKind::stroke);
  write_png(folder_ / "named.h5", Image(2, 2));
  EXPECT_EQ(kind_of(folder_ / "named.h5"), InputKind::picture);
}

TEST_F(InputKinds, AreUnknownWhereSeveralOrNoneAreMeant) {
  EXPECT_EQ(kind_of_text(""), InputKind::unknown);
  EXPECT_EQ(kind_of_text("force = 2.0\n"), InputKind::unknown);
  EXPECT_EQ(kind_of_text("[bed]\n[sweep]\n"), InputKind::unknown);
  EXPECT_EQ(kind_of_text("[bed\n"), InputKind::unknown);
  EXPECT_EQ(kind_of_text(std::string(hdf5_signature) + "damaged"), InputKind::unknown);
  EXPECT_EQ(kind_of_format("other"), InputKind::unknown);
  EXPECT_EQ(kind_of(folder_ / "absent.toml"), InputKind::unknown);
  EXPECT_EQ(kind_of(folder_.path()), InputKind::unknown);
}

TEST_F(InputKinds, WhatIsNotWantedIsRefusedWithWhatItIsFor) {
  const std::filesystem::path plan = text("[sweep]\nscene = 'a.toml'\n", "plan.toml");
  expect_kind(plan, {InputKind::plan});
  expect_kind(folder_ / "absent.toml", {InputKind::plan});
  try {
    expect_kind(plan, {InputKind::scene});
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::input);
    EXPECT_EQ(error.what(),
              plan.string() + ": is a sweep plan, not a scene; run it: sandstroke sweep " + plan.string());
  }
}

}  // namespace
}  // namespace sandstroke
