#include "core/output_file.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "test_folder.h"

namespace sandstroke {
namespace {

namespace fs = std::filesystem;

TEST(OutputFile, IsPutInPlaceWhole) {
  const fs::path path = fs::path(testing::TempDir()) / "output_file_test.txt";
  write_text_file(path, "first");
  write_text_file(path, "second");
  EXPECT_EQ(read_text_file(path), "second");
  EXPECT_FALSE(fs::exists(part_path(path)));
  fs::remove(path);
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
