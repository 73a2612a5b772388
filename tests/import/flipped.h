#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>

#include "complaint.h"
#include "test_folder.h"

namespace sandstroke {

/// Reads a file again and again, each time with another bit flipped. Each answer must be one sentence, or
/// columns of equal length. read: gets the path, and returns a SampleTable.
template <class Read>
void expect_answers_to_flips(const std::filesystem::path& path, const Read& read, int flips = 100) {
  std::ifstream file(path, std::ios::binary);
  const std::string whole{std::istreambuf_iterator<char>(file), {}};
  const std::filesystem::path flipped = path.parent_path() / ("flipped" + path.extension().string());
  std::mt19937 random(1);
  for (int i = 0; i < flips; ++i) {
    std::string bytes = whole;
    bytes[random() % bytes.size()] ^= static_cast<char>(1 << random() % 8);
    put_text(flipped, bytes);
    const std::string complaint = complaint_of([&] {
      const SampleTable table = read(flipped);
      for (const SampleColumn& column : table.columns) EXPECT_EQ(column.values.size(), table.size());
    });
    EXPECT_EQ(complaint.find('\n'), std::string::npos) << complaint;
  }
}

}  // namespace sandstroke
