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

constexpr OutputKind text_kind{"a text", "first"};

TEST(OutputFile, IsPutInPlaceWhole) {
  const TestFolder folder;
  const fs::path path = folder / "file";
  write_text_file(path, "first", text_kind);
  write_text_file(path, "first but one", text_kind);
  EXPECT_EQ(read_text_file(path), "first but one");
  EXPECT_FALSE(fs::exists(part_path(path)));
}

TEST(OutputFile, LeavesWhatWasThereIfItIsNotWrittenToItsEnd) {
  const TestFolder folder;
  const fs::path path = folder / "file";
  EXPECT_TRUE(write_file(path, text_kind, [](std::ostream& file) { return bool(file << "first"); }));
  EXPECT_FALSE(write_file(path, text_kind, [](std::ostream& file) {
    file << "fi";
    return false;
  }));
  EXPECT_THROW(write_file(path, text_kind,
                          [](std::ostream& file) -> bool {
                            file << "fi" << std::flush;
                            throw_input_error("{}: no", "file");
                          }),
               Error);
  EXPECT_EQ(read_text_file(path), "first");
  EXPECT_FALSE(fs::exists(part_path(path)));
}

TEST(OutputFile, AnHdf5FileHasNoNameOfAnotherFormat) {
  const TestFolder folder;
  constexpr OutputKind hdf5{.name = "a run file", .hdf5 = true};
  for (const char* name : {"a.h5", "a.hdf5", "A.H5", "a", "run-27.5", "b.csv/a", ".hidden"})
    EXPECT_NO_THROW(check_replaceable(folder / name, hdf5)) << name;
  for (const char* name : {"a.csv", "a.png", "a.h5.part", "a.h5x", "a.mp4", "a.3mf", "run-27.5s"})
    EXPECT_THROW(take_part(folder / name, hdf5), Error) << name;
  EXPECT_TRUE(fs::is_empty(folder.path()));
  EXPECT_NO_THROW(check_replaceable(folder / "a.csv", text_kind));
}

TEST(OutputFile, IsNotWrittenByTwoAtATime) {
  const TestFolder folder;
  const fs::path path = folder / "file";
  {
    const FileLock writing = take_part(path, {});
    EXPECT_THROW(write_text_file(path, "another's"), Error);
    EXPECT_THROW(take_part(path, {}), Error);
    EXPECT_FALSE(fs::exists(path));
    EXPECT_TRUE(fs::exists(part_path(path)));  // of the one that has it
  }
  write_text_file(path, "mine");  // whoever had it was killed
  EXPECT_EQ(read_text_file(path), "mine");
}

TEST(OutputFile, IsRefusedAtTheNameOfAFolderAndLeavesNothing) {
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
    EXPECT_THROW(take_part(path, {}), Error);
    fs::remove(part_path(path));
  }
  EXPECT_EQ(read_text_file(folder / "precious"), "text");
  EXPECT_FALSE(fs::exists(folder / "nothing"));
  EXPECT_FALSE(fs::exists(path));
  ASSERT_EQ(mkfifo(part_path(path).c_str(), 0600), 0);
  EXPECT_THROW(write_text_file(path, "bad"), Error);
  fs::remove(part_path(path));
  fs::create_symlink("precious", path);
  EXPECT_THROW(write_text_file(path, "bad"), Error);
  EXPECT_EQ(read_text_file(folder / "precious"), "text");
  EXPECT_TRUE(fs::is_symlink(path));
}

TEST(OutputFile, ReplacesNothingOfAnotherKind) {
  const TestFolder folder;
  const fs::path path = folder / "file";
  struct Case {
    std::string there;
    OutputKind kind;
    bool replaced;
  };
  const OutputKind marked{"a list", "list\n", "by us"}, one{"one", "list\n", "by us", 0, true};
  const std::string far(64 * 1024, ' ');
  for (const auto& [there, kind, replaced] : std::vector<Case>{
           {"", {}, true},
           {"x", {}, false},
           {"list\nby us", {}, false},
           {"list\nby us", marked, true},
           {"list\nby them", marked, false},
           {"a list\nby us", marked, false},
           {"list\n" + far + "by us", marked, false},
           {"list\n", {"a list", "list\n", "by us", 5}, true},
           {"list\n.", {"a list", "list\n", "by us", 5}, false},
           {std::string("list\n\0\0", 7), {"a list", "list\n", "by us", 5}, true},
           {std::string("list\n\0.", 7), {"a list", "list\n", "by us", 5}, false},
           {"lis", {"a list", "list\n", "by us", 5}, false},
           {"list\nby us", one, false},
       }) {
    put_text(path, there);
    if (replaced) {
      EXPECT_NO_THROW(check_output(path, {}, kind)) << there;
    } else {
      EXPECT_THROW(check_output(path, {}, kind), Error) << there;
      EXPECT_THROW(write_text_file(path, "new", kind), Error) << there;
      EXPECT_EQ(read_text_file(path), there);
    }
    fs::remove(path);
    // The same of PATH.part; one that is kept was not yet.
    put_text(part_path(path), there);
    if (replaced || kind.kept) {
      EXPECT_NO_THROW(write_text_file(path, "new", kind)) << there;
      EXPECT_EQ(read_text_file(path), "new");
    } else {
      EXPECT_THROW(check_output(path, {}, kind), Error) << there;
      EXPECT_THROW(write_text_file(path, "new", kind), Error) << there;
      EXPECT_EQ(read_text_file(part_path(path)), there);
    }
    fs::remove(path);
    fs::remove(part_path(path));
  }
}

TEST(OutputFile, WhatTheDiskDoesNotGiveBackIsNotTakenForAnEmptyFile) {
  try {
    check_replaceable("/proc/self/mem", text_kind);  // at address 0 there is nothing: reading it is an EIO
    FAIL() << "it would be replaced";
  } catch (const Error& failure) {
    EXPECT_EQ(failure.kind(), ErrorKind::io);
    EXPECT_NE(std::string(failure.what()).find("cannot be read (Input/output error)"), std::string::npos)
        << failure.what();
  }
}

TEST(OutputFile, ThatComesWhileAnotherIsWrittenStays) {
  const TestFolder folder;
  const fs::path path = folder / "file";
  const FileLock writing = take_part(path, text_kind);
  put_text(part_path(path), "first");
  put_text(path, "somebody's");
  EXPECT_THROW(finish_part(path, text_kind), Error);
  EXPECT_EQ(read_text_file(path), "somebody's");
  EXPECT_EQ(read_text_file(part_path(path)), "first");
}

TEST(OutputFile, KeepsTheModeOfWhatItReplaces) {
  const TestFolder folder;
  const fs::path path = folder / "file";
  using fs::perms;
  for (const perms mode : {perms(0600), perms(0640), perms(0777)}) {
    put_text(path, "first");
    fs::permissions(path, mode);
    {
      const FileLock writing = take_part(path, text_kind);  // nobody may read more of it meanwhile
      EXPECT_EQ(fs::status(part_path(path)).permissions(), mode);
    }
    write_text_file(path, "first but one", text_kind);
    EXPECT_EQ(fs::status(path).permissions(), mode);
  }
  fs::permissions(path, perms(0444));  // by whom it is writable or not: also by root
  EXPECT_THROW(check_output(path, {}, text_kind), Error);
  EXPECT_THROW(write_text_file(path, "first of all", text_kind), Error);
  EXPECT_EQ(read_text_file(path), "first but one");
}

TEST(OutputFile, ItsNameHasRoomForItsEnding) {
  const TestFolder folder;
  EXPECT_NO_THROW(check_output(folder / std::string(250, 'x'), {}, {}));  // and .part: 255
  EXPECT_ANY_THROW(check_output(folder / std::string(251, 'x'), {}, {}));
}

TEST(OutputFile, ItsPartIsNoInputEither) {
  const TestFolder folder;
  EXPECT_THROW(check_output(folder / "file", {folder / "file.part"}, {}), Error);
  EXPECT_NO_THROW(check_output(folder / "file", {folder / "file.h5"}, {}));
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
    const FileLock writing = take_part(folder / "file", {"a text", "text"});
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
  fs::remove(folder / "file");
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
