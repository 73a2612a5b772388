#include "compare/replace_folder.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <string>

#include "core/input_file.h"
#include "core/output_file.h"
#include "test_folder.h"

namespace {

/// The calls of this program that the system refuses.
struct Refused {
  bool exchange = false;  // as file systems that cannot
  std::string place;      // what is to be put there, once
};
Refused refused;

int really_rename(const char* from, const char* to, unsigned flags) {
  return static_cast<int>(syscall(SYS_renameat2, AT_FDCWD, from, AT_FDCWD, to, flags));
}

}  // namespace

// This program calls these in place of the system's own.
extern "C" {
int renameat2(int, const char* from, int, const char* to, unsigned flags) noexcept {
  if (!refused.exchange) return really_rename(from, to, flags);
  errno = EINVAL;
  return -1;
}
int rename(const char* from, const char* to) noexcept {
  if (to != refused.place) return really_rename(from, to, 0);
  refused.place.clear();
  errno = EIO;
  return -1;
}
}

namespace sandstroke {
namespace {
namespace fs = std::filesystem;

class ReplacedFolder : public testing::TestWithParam<bool> {
 protected:
  ReplacedFolder() { refused.exchange = !GetParam(); }
  ~ReplacedFolder() override { refused = {}; }

  void make(const fs::path& path, const std::string& content) {
    fs::create_directories(path);
    put_text(path / "content", content);
  }
  void replace(const std::string& content) {
    make(made, content);
    replace_folder(made, place);
    fs::remove_all(made);  // the old one
  }
  /// The content of what is in place, which must be all there is.
  std::string content() const {
    EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator()), 1);
    return read_text_file(place / "content");
  }

  const TestFolder folder;
  const fs::path made = folder / "dune.new.part", place = folder / "dune", old = folder / "dune.old.part";
};

TEST_P(ReplacedFolder, IsTheNewOne) {
  for (const char* text : {"first", "second", "third"}) {
    replace(text);
    EXPECT_EQ(content(), text);
  }
}

TEST_P(ReplacedFolder, StaysWhereTheNewOneIsRefused) {
  if (GetParam()) GTEST_SKIP() << "names are exchanged in one step";
  replace("first");
  refused.place = place.string();
  EXPECT_THROW(replace("second"), fs::filesystem_error);
  EXPECT_EQ(read_text_file(place / "content"), "first");
  replace("second");
  EXPECT_EQ(content(), "second");
}

TEST_P(ReplacedFolder, WhatAKillLeftGoesOnlyWhenTheNewOneIsInPlace) {
  make(old, "first");
  refused.place = place.string();
  EXPECT_THROW(replace("second"), fs::filesystem_error);
  EXPECT_EQ(read_text_file(place / "content"), "first") << "it is back";
  replace("second");
  EXPECT_EQ(content(), "second");
}

TEST_P(ReplacedFolder, ALinkIsReplacedAndNotFollowed) {
  const TestFolder elsewhere;
  make(elsewhere / "dune", "of somebody else");
  fs::create_directory_symlink(elsewhere / "dune", place);
  replace("first");
  EXPECT_EQ(content(), "first");
  EXPECT_FALSE(fs::is_symlink(place));
  EXPECT_EQ(read_text_file(elsewhere / "dune/content"), "of somebody else");
}

INSTANTIATE_TEST_SUITE_P(Places, ReplacedFolder, testing::Bool(), [](const auto& one) {
  return one.param ? "NamesAreExchanged" : "NamesAreNotExchanged";
});

}  // namespace
}  // namespace sandstroke
