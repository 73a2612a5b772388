#include "hdf5/part_driver.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include <fstream>

#include "any_hdf5.h"
#include "core/error.h"
#include "core/input_file.h"
#include "hdf5/hdf5_file.h"
#include "test_folder.h"

namespace sandstroke {
namespace {

class PartDriver : public testing::Test {
 protected:
  /// A .part that was flushed, and then written to: what it holds on the disk.
  std::string flushed_and_written_to() {
    Hdf5Writer file(path_, any_hdf5);
    Hdf5Column numbers = file.column("/number");
    const std::vector<double> rows(5000, 1.0);
    numbers.append(rows.data(), rows.size());
    file.flush();
    numbers.append(rows.data(), rows.size());
    file.write("/more", std::vector<double>(20'000, 2.0));  // beyond HDF5's own buffers
    return read_text_file(part_);
  }

  TestFolder folder_;
  const std::filesystem::path path_ = folder_ / "a.h5", part_ = folder_ / "a.h5.part";
};

TEST_F(PartDriver, WhatWasNotCommittedIsNotThere) {
  flushed_and_written_to();
  const Hdf5Reader file(part_);
  EXPECT_EQ(file.doubles("/number").size(), 5000u);
  EXPECT_FALSE(file.has("/more"));
}

TEST_F(PartDriver, WhateverLiesBehindTheEndIsNotBelieved) {
  const std::string bytes = flushed_and_written_to();
  constexpr std::size_t page = 8 + 4096;
  std::string pages(3 * page, '\xff');  // of address 2^64 - 1
  const std::string mark = "sandstroke pages";
  for (const std::uint64_t count : {std::uint64_t{0}, std::uint64_t{3}, std::uint64_t{1} << 60}) {
    std::string seal = mark + std::string(16, '\0');
    std::copy_n(reinterpret_cast<const char*>(&count), 8, seal.begin() + 16);
    std::ofstream(part_, std::ios::binary) << bytes << pages << seal;
    EXPECT_EQ(Hdf5Reader(part_).doubles("/number").size(), 5000u) << count;
  }
}

TEST_F(PartDriver, PagesThatNoCommitWritesAreNotBelieved) {
  const std::string bytes = flushed_and_written_to() + std::string(4096, '\0');
  const std::string begin = bytes.substr(0, bytes.size() / 4096 * 4096);
  const auto number = [](std::uint64_t value) {
    return std::string(reinterpret_cast<const char*>(&value), 8);
  };
  for (const std::vector<std::uint64_t>& addresses : {std::vector<std::uint64_t>{0, 0},  // as in a hole
                                                      {4096, 0},
                                                      {100},
                                                      {1ULL << 40}}) {
    std::string pages;
    uLong checksum = 0;
    for (const std::uint64_t address : addresses) {
      const std::string page = number(address) + std::string(4096, '\xff');
      checksum = crc32(checksum, reinterpret_cast<const Bytef*>(page.data()), static_cast<uInt>(page.size()));
      pages += page;
    }
    std::ofstream(part_, std::ios::binary)
        << begin << pages << "sandstroke pages" << number(addresses.size()) << number(checksum);
    EXPECT_EQ(Hdf5Reader(part_).doubles("/number").size(), 5000u) << addresses.front();
  }
}

TEST_F(PartDriver, AFinishedFileIsAnOrdinaryOne) {
  {
    Hdf5Writer file(path_, any_hdf5);
    Hdf5Column numbers = file.column("/number");  // still open where the file is finished
    const std::vector<double> rows(5000, 1.0);
    numbers.append(rows.data(), rows.size());
    file.finish();
  }
  EXPECT_EQ(read_text_file(path_).find("sandstroke pages"), std::string::npos);
  EXPECT_EQ(Hdf5Reader(path_).doubles("/number"), std::vector<double>(5000, 1.0));
}

}  // namespace
}  // namespace sandstroke
