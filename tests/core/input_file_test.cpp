#include "core/input_file.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <fstream>
#include <thread>

#include "core/error.h"
#include "core/hash.h"
#include "core/output_file.h"
#include "test_folder.h"

namespace sandstroke {
namespace {

namespace fs = std::filesystem;

/// A text of several blocks, no two of which are the same.
std::string long_text() {
  std::string text;
  for (int i = 0; text.size() < 300'001; ++i) text += std::to_string(i * i) + '\n';
  return text;
}

/// The kind of what is thrown, and its sentence.
template <class Read>
std::string refusal(const Read& read, ErrorKind kind) {
  try {
    read();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), kind) << error.what();
    return error.what();
  }
  return "nothing was refused";
}

TEST(InputFile, GivesAllBytesInOrder) {
  const TestFolder folder;
  const std::string text = long_text();
  write_text_file(folder / "file", text);
  EXPECT_EQ(read_text_file(folder / "file"), text);
  EXPECT_EQ(file_hash(folder / "file"), content_hash(text));
  InputFile file(folder / "file");
  std::string part(100'000, '\0'), whole;
  for (std::size_t count = 1; count > 0;) {  // of all sizes, and blocks in between
    count = file.read(part.data(), whole.size() % 7919 + 1);
    whole += part.substr(0, count);
    if (whole.size() % 3 == 0) whole += file.next_block();
  }
  EXPECT_EQ(whole, text);
}

TEST(InputFile, GoesOnAtAnyByte) {
  const TestFolder folder;
  const std::string text = long_text();
  write_text_file(folder / "file", text);
  InputFile file(folder / "file");
  std::string part(100, '\0');
  for (const std::size_t at : {0ul, 50ul, 60'000ul, 65'536ul, 300'000ul, 7ul, 7ul, 131'071ul, 131'072ul}) {
    file.seek(at);
    const std::size_t count = file.read(part.data(), part.size());
    EXPECT_EQ(part.substr(0, count), text.substr(at, part.size())) << at;
    EXPECT_EQ(file.next_block().substr(0, 3), text.substr(std::min(at + count, text.size())).substr(0, 3))
        << at;
  }
  file.seek(text.size() + 10);
  EXPECT_EQ(file.read(part.data(), 1), 0u);
  EXPECT_TRUE(file.next_block().empty());
}

/// Bytes that this process has read from files so far, as Linux counts them.
std::size_t bytes_read() {
  std::ifstream io("/proc/self/io");
  std::string name;
  std::size_t count = 0;
  while (io >> name >> count && name != "rchar:") {
  }
  return count;
}

TEST(InputFile, AByteOfTheSameBlockIsNotReadAgain) {
  if (!fs::exists("/proc/self/io")) GTEST_SKIP() << "this system does not count what is read";
  const TestFolder folder;
  const std::string text = long_text();
  write_text_file(folder / "file", text);
  InputFile file(folder / "file");
  const std::size_t before = bytes_read();
  // Records in turn, each with a look at the last byte before it.
  char record[13];
  for (std::size_t at = 1; at + sizeof record < text.size(); at += sizeof record) {
    file.seek(at - 1);
    ASSERT_EQ(file.read(record, 1), 1u);
    ASSERT_EQ(file.read(record, sizeof record), sizeof record);
    ASSERT_EQ(std::string_view(record, sizeof record), std::string_view(text).substr(at, sizeof record));
  }
  EXPECT_LT(bytes_read() - before,
            text.size() + 500'000);  // once, and some blocks more where records straddle
}

TEST(InputFile, WhatTheDiskDoesNotGiveIsAnError) {
  const fs::path damaged = "/proc/self/mem";  // at address 0 there is nothing: reading it is an EIO
  for (const std::string& sentence : {refusal([&] { read_text_file(damaged); }, ErrorKind::io),
                                      refusal([&] { begins_with(damaged, "x"); }, ErrorKind::io),
                                      refusal([&] { file_hash(damaged); }, ErrorKind::io),
                                      refusal([&] { check_can_be_read_whole(damaged); }, ErrorKind::io)})
    EXPECT_EQ(sentence,
              "/proc/self/mem: cannot be read (Input/output error); check the disk, or take another copy of "
              "the file");
}

TEST(InputFile, ATextIsNoLongerThanSomebodyWrites) {
  const TestFolder folder;
  write_text_file(folder / "text", "");
  fs::resize_file(folder / "text", most_text_bytes);
  EXPECT_EQ(read_text_file(folder / "text").size(), most_text_bytes);
  fs::resize_file(folder / "text", 300'000'000);
  const std::string sentence = refusal([&] { read_text_file(folder / "text"); }, ErrorKind::input);
  EXPECT_NE(sentence.find("text: has 300.0 MB, but a text file may have at most 10 MB; shorten it"),
            std::string::npos)
      << sentence;
}

TEST(InputFile, APipeIsReadToItsEnd) {
  const TestFolder folder;
  const fs::path pipe = folder / "pipe";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  const std::string text = long_text();
  std::thread writer([&] { std::ofstream(pipe) << text; });
  EXPECT_EQ(read_text_file(pipe), text);
  writer.join();
}

TEST(InputFile, BeginsWithAllOfTheSignatureOrNot) {
  const TestFolder folder;
  write_text_file(folder / "file", "signature and more");
  EXPECT_TRUE(begins_with(folder / "file", "signature"));
  EXPECT_FALSE(begins_with(folder / "file", "Signature"));
  write_text_file(folder / "short", "sig");
  EXPECT_FALSE(begins_with(folder / "short", "signature"));
}

}  // namespace
}  // namespace sandstroke
