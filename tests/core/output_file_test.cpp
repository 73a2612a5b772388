#include "core/output_file.h"
#include "core/input_file.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include "core/error.h"
#include "test_folder.h"

namespace sandstroke {
namespace {

namespace fs = std::filesystem;

TEST(OutputFile, IsPutInPlaceWhole) {
  const TestFolder folder;
  const fs::path path = folder / "file";
  write_text_file(path, "first");
  write_text_file(path, "second");
  EXPECT_EQ(read_text_file(path), "second");
  EXPECT_FALSE(fs::exists(part_path(path)));
}

TEST(OutputFile, IsNotWrittenByTwoAtATime) {
  const TestFolder folder;
  const fs::path path = folder / "file";
  {
    const FileLock writing = take_part(path);
    EXPECT_THROW(write_text_file(path, "another's"), Error);
    EXPECT_THROW(take_part(path), Error);
    EXPECT_FALSE(fs::exists(path));
    EXPECT_TRUE(fs::exists(part_path(path)));  // of the one that has it
  }
  write_text_file(path, "mine");  // whoever had it was killed
  EXPECT_EQ(read_text_file(path), "mine");
}

TEST(OutputFile, ThatTakesAPlaceOfAFolderIsRefusedAndLeavesNothing) {
  const TestFolder folder;
  make_folder(folder / "file.part");
  EXPECT_THROW(write_text_file(folder / "file", "text"), Error);
  EXPECT_FALSE(fs::exists(folder / "file"));
}

TEST(OutputFile, ErrorsNameFileAndRemedy) {
  try {
    write_text_file("/nowhere/at/all.txt", "text");
    FAIL();
  } catch (const Error& failure) {
    EXPECT_EQ(failure.kind(), ErrorKind::io);
    EXPECT_NE(std::string(failure.what()).find("/nowhere/at/all.txt"), std::string::npos);
  }
  EXPECT_THROW(read_text_file("/nowhere/at/all.txt"), Error);
  EXPECT_THROW(read_text_file("/"), Error);
  EXPECT_THROW(read_text_file("/dev/zero"), Error);  // which has no end
}

TEST(OutputFile, NothingIsWrittenThroughALinkOrPipe) {
  const TestFolder folder;
  write_text_file(folder / "precious", "text");
  const fs::path path = folder / "file";
  for (const char* target : {"precious", "nothing"}) {
    fs::create_symlink(target, part_path(path));
    EXPECT_THROW(write_text_file(path, "bad"), Error);
    EXPECT_THROW(take_part(path), Error);
    fs::remove(part_path(path));
  }
  EXPECT_EQ(read_text_file(folder / "precious"), "text");
  EXPECT_FALSE(fs::exists(folder / "nothing"));
  EXPECT_FALSE(fs::exists(path));
  ASSERT_EQ(mkfifo(part_path(path).c_str(), 0600), 0);
  EXPECT_THROW(write_text_file(path, "bad"), Error);
  fs::remove(part_path(path));
  // A link to where the file is to be: the file takes its place, what it led to stays.
  fs::create_symlink("precious", path);
  write_text_file(path, "new");
  EXPECT_EQ(read_text_file(folder / "precious"), "text");
  EXPECT_FALSE(fs::is_symlink(path));
}

TEST(OutputFile, WhatMightNeverEndIsNoInput) {
  const TestFolder folder;
  ASSERT_EQ(mkfifo((folder / "pipe").c_str(), 0600), 0);
  EXPECT_THROW(check_readable(folder / "pipe"), Error);
  EXPECT_THROW(check_readable("/dev/zero"), Error);
  EXPECT_THROW(read_text_file("/dev/zero"), Error);
}

TEST(OutputFile, WhatIsNotToBeKeptLeavesNothing) {
  const TestFolder folder;
  write_text_file(folder / "file", "text");
  {
    const FileLock writing = take_part(folder / "file");
    drop_part(folder / "file");
  }
  EXPECT_FALSE(fs::exists(part_path(folder / "file")));
  EXPECT_EQ(read_text_file(folder / "file"), "text");
  drop_part(folder / "file");  // there is none: no error
  drop_part("/nowhere/at/all.txt");
}

TEST(OpenFile, IsStillNamedUntilAnotherHasItsName) {
  const TestFolder folder;
  write_text_file(folder / "file", "text");
  const int file = open((folder / "file").c_str(), O_RDONLY);
  ASSERT_GE(file, 0);
  EXPECT_TRUE(still_named(file, folder / "file"));
  fs::create_hard_link(folder / "file", folder / "again");
  EXPECT_TRUE(still_named(file, folder / "again"));
  write_text_file(folder / "file", "text");  // alike, but another
  EXPECT_FALSE(still_named(file, folder / "file"));
  EXPECT_FALSE(still_named(file, folder / "nothing"));
  close(file);
  EXPECT_FALSE(still_named(file, folder / "again"));
}

TEST(MakeFolder, MakesAllOnTheWayAndSaysWhatIsInIt) {
  const TestFolder folder;
  make_folder(folder / "a/b/c");
  EXPECT_TRUE(fs::is_directory(folder / "a/b/c"));
  make_folder(folder / "a/b/c");
  write_text_file(folder / "file", "text");
  EXPECT_THROW(make_folder(folder / "file"), Error);
  EXPECT_THROW(make_folder(folder / "file/below"), Error);
}

}  // namespace
}  // namespace sandstroke
