#include "export/grid_files.h"

#include <gtest/gtest.h>

#include <cstring>
#include <sstream>

namespace sandstroke {
namespace {

HeightGrid grid_heights() {
  HeightGrid heights(2, 3);
  heights << 0.1, -0.2, 1.0 / 3.0, 1e-300, 0.0, 12345.678901234567;
  return heights;
}

std::string written(const GridFormat& format, const HeightGrid& heights, double cell_size) {
  std::ostringstream file;
  EXPECT_TRUE(format.write(file, heights, cell_size));
  EXPECT_GE(format.bytes(static_cast<double>(heights.size())), static_cast<double>(file.str().size()));
  return file.str();
}

TEST(GridFiles, AnNpyIsVersion1WithRowsOfYAsInARunFile) {
  const HeightGrid heights = grid_heights();
  const std::string bytes = written(npy_format, heights, 0.5);
  EXPECT_EQ(bytes.substr(0, 8), std::string("\x93NUMPY\x01\x00", 8));
  const std::size_t header =
      static_cast<unsigned char>(bytes[8]) + 256u * static_cast<unsigned char>(bytes[9]);
  EXPECT_EQ((10 + header) % 64, 0u);
  EXPECT_EQ(bytes.substr(10, header).find("{'descr': '<f8', 'fortran_order': False, 'shape': (2, 3), }"), 0u);
  EXPECT_EQ(bytes[10 + header - 1], '\n');
  ASSERT_EQ(bytes.size(), 10 + header + 6 * sizeof(double));
  EXPECT_EQ(std::memcmp(bytes.data() + 10 + header, heights.data(), 6 * sizeof(double)), 0);
  for (int cols : {1, 9, 10, 99, 100, 65536})  // the padding follows the header's length
    EXPECT_EQ(written(npy_format, HeightGrid::Zero(1, cols), 0.5).size() % 64, 8u * cols % 64);
}

TEST(GridFiles, AnEsriGridBeginsInTheNorthWestAndKeepsTheBits) {
  const HeightGrid heights = grid_heights();
  std::istringstream file(written(esri_grid_format, heights, 0.1));
  const auto value_of = [&](const std::string& key) {
    std::string name;
    double value = 0.0;
    file >> name >> value;
    EXPECT_EQ(name, key);
    return value;
  };
  EXPECT_EQ(value_of("ncols"), 3);
  EXPECT_EQ(value_of("nrows"), 2);
  EXPECT_NEAR(value_of("xllcorner"), -0.15, 1e-16);
  EXPECT_NEAR(value_of("yllcorner"), -0.1, 1e-16);
  EXPECT_EQ(value_of("cellsize"), 0.1);
  value_of("NODATA_value");
  std::string rest;
  std::getline(file, rest);
  for (const int row : {1, 0}) {
    std::getline(file, rest);
    std::istringstream line(rest);
    for (int col = 0; col < 3; ++col) {
      std::string word;
      line >> word;
      EXPECT_EQ(std::strtod(word.c_str(), nullptr), heights(row, col));
    }
    EXPECT_TRUE(line.eof());
  }
  EXPECT_FALSE(std::getline(file, rest));
}

}  // namespace
}  // namespace sandstroke
