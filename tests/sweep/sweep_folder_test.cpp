#include "sweep/sweep_folder.h"

#include <gtest/gtest.h>

#include <fstream>

#include "core/error.h"
#include "core/output_file.h"
#include "hdf5/hdf5_reader.h"
#include "sand/initial_surface.h"
#include "test_folder.h"

namespace sandstroke {
namespace {

namespace fs = std::filesystem;

class AFolder : public testing::Test {
 protected:
  TestFolder temporary;
  const fs::path path = temporary / "sweep";
};

SweepManifest manifest() {
  SweepManifest m;
  m.scene = "/somewhere/it's here/scene.toml";
  m.settings = {"bed.cells=[64, 64]"};
  m.design = {true,
              {{"relaxation.talus_angle", "deg", false, {"20", "30"}},
               {"model.preset", "", false, {"\"paper\"", "\"accurate\""}}}};
  m.metrics = {"max_force", "work"};
  m.inputs = {{"scene.toml", "0123"}};
  m.version = "1";
  m.commit = "abc";
  return m;
}

std::string refusal(const fs::path& path, const SweepManifest& m) {
  try {
    SweepFolder::make(path, m);
  } catch (const Error& failure) {
    return failure.what();
  }
  return "";
}

TEST_F(AFolder, IsTakenUpBySameSweepAndOpenedAsItWasMade) {
  SweepFolder::make(path, manifest());
  SweepManifest moved = manifest();
  moved.scene = "/elsewhere/scene.toml";
  moved.inputs[0].first = "there.toml";
  EXPECT_EQ(SweepFolder::make(path, moved).manifest().scene, manifest().scene);
  const SweepFolder opened = SweepFolder::open(path);
  EXPECT_EQ(opened.points(), 4u);
  EXPECT_EQ(opened.metrics()[1].name, "work");
  EXPECT_EQ(opened.design().settings(3), manifest().design.settings(3));
  EXPECT_EQ(opened.command(2),
            "sandstroke run '/somewhere/it'\\''s here/scene.toml' --set 'bed.cells=[64, 64]' --set "
            "relaxation.talus_angle=30 --set 'model.preset=\"paper\"' -o point-000002.h5");
}

TEST_F(AFolder, IsRefusedWithWhatDiffersIfAnotherSweepMadeIt) {
  SweepFolder::make(path, manifest());
  SweepManifest other = manifest();
  other.design.axes[0].values.push_back("40");
  EXPECT_NE(refusal(path, other).find("whose axes differ"), std::string::npos) << refusal(path, other);
  other = manifest();
  other.inputs[0].second = "4567";
  EXPECT_NE(refusal(path, other).find("scene, strokes or other files"), std::string::npos);
  other = manifest();
  other.commit = "def";
  EXPECT_NE(refusal(path, other).find("another version of sandstroke (1, abc)"), std::string::npos);
}

TEST_F(AFolder, IsRefusedIfItHasFilesOfOthersOrADamagedManifest) {
  fs::create_directories(path);
  put_text(path / "thesis.txt", "precious");
  EXPECT_NE(refusal(path, manifest()).find("other files"), std::string::npos);
  EXPECT_THROW(SweepFolder::open(path), Error);
  for (const char* text : {"", "{", "{}", "[]", R"({"format": 5})"}) {
    put_text(path / "manifest.json", text);
    EXPECT_THROW(SweepFolder::open(path), Error) << text;
  }
}

TEST_F(AFolder, ThatAnotherProcessIsMakingIsTakenUp) {
  fs::create_directories(path / "points");
  put_text(path / "manifest-1.json.part", "{");
  EXPECT_EQ(SweepFolder::make(path, manifest()).points(), 4u);
}

TEST_F(AFolder, WhosePointsLieElsewhereIsRefused) {
  fs::create_directories(path);
  fs::create_directories(temporary / "elsewhere");
  fs::create_directory_symlink(temporary / "elsewhere", path / "points");
  EXPECT_NE(refusal(path, manifest()).find("is a link"), std::string::npos) << refusal(path, manifest());
}

TEST_F(AFolder, IsRefusedIfItHasPointsButNoManifest) {
  SweepFolder::make(path, manifest()).write(0, {PointVerdict::at_rest, "", {1.0, 2.0}}, "", {});
  fs::remove(path / "manifest.json");
  EXPECT_NE(refusal(path, manifest()).find("holds points"), std::string::npos) << refusal(path, manifest());
}

TEST_F(AFolder, WhoseManifestHasNotAValueOfEachAxisForEachPointIsRefused) {
  for (const bool grid : {true, false}) {
    SweepManifest damaged = manifest();
    damaged.design.grid = grid;
    damaged.design.axes[1].values.resize(grid ? 0 : 1);
    SweepFolder::make(path, damaged);
    EXPECT_THROW(SweepFolder::open(path), Error) << grid;
    fs::remove(path / "manifest.json");
  }
}

TEST_F(AFolder, WhoseManifestHasMorePointsThanAPlanMayIsRefused) {
  SweepManifest huge = manifest();
  for (const char* key : {"force.k_s", "force.k_f", "tool.radius", "device.mass"})
    huge.design.axes.push_back({key, "", false, std::vector<std::string>(1 << 16, "1")});  // 2^64 of them
  SweepFolder::make(path, huge);
  EXPECT_THROW(SweepFolder::open(path), Error);
}

TEST_F(AFolder, GivesPointsBackToTheBit) {
  const SweepFolder folder = SweepFolder::make(path, manifest());
  EXPECT_FALSE(folder.read(3));
  HeightField surface = make_surface({}, 70, 90, 0.25);
  surface.set(3, 80, -0.1);
  folder.write(3, {PointVerdict::active, "", {0.1, PointResult::none}}, "[bed]\n", {&surface});
  const auto result = folder.read(3);
  ASSERT_TRUE(result);
  EXPECT_EQ(result->verdict, PointVerdict::active);
  EXPECT_EQ(result->metrics[0], 0.1);
  EXPECT_TRUE(std::isnan(result->metrics[1]));
  const Hdf5Reader file(folder.point_file(3));
  EXPECT_TRUE((file.grid("/surface") == surface.grid()).all());
  EXPECT_EQ(file.number_attribute("/surface", "cell_size"), 0.25);

  folder.write(1, {PointVerdict::unstable, "it \"blew\" up", {PointResult::none, PointResult::none}}, "", {});
  EXPECT_EQ(folder.read(1)->reason, "it \"blew\" up");
}

TEST_F(AFolder, APointThatWasCutOffIsMissing) {
  const SweepFolder folder = SweepFolder::make(path, manifest());
  folder.write(2, {PointVerdict::at_rest, "", {1.0, 2.0}}, "", {});
  fs::resize_file(folder.point_file(2), fs::file_size(folder.point_file(2)) / 2);
  EXPECT_FALSE(folder.read(2));
  std::ofstream(folder.point_file(1)) << "";
  EXPECT_FALSE(folder.read(1));
  // Another point's file under this name.
  folder.write(0, {PointVerdict::at_rest, "", {1.0, 2.0}}, "", {});
  fs::rename(folder.point_file(0), folder.point_file(2));
  EXPECT_FALSE(folder.read(2));
}

}  // namespace
}  // namespace sandstroke
