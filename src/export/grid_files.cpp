#include "export/grid_files.h"

#include <spdlog/fmt/fmt.h>

#include <bit>
#include <cmath>
#include <iterator>
#include <string>

#include "core/interrupt.h"

namespace sandstroke {
namespace {

static_assert(std::endian::native == std::endian::little);

bool write_npy(std::ostream& file, const HeightGrid& heights, double) {
  // Version 1.0 of the format: what comes before the numbers takes a multiple of 64 bytes and ends with a
  // newline.
  std::string header = fmt::format("{{'descr': '<f8', 'fortran_order': False, 'shape': ({}, {}), }}",
                                   heights.rows(), heights.cols());
  constexpr std::size_t before = 10;
  header.append(63 - (before + header.size()) % 64, ' ');
  header += '\n';
  file.write("\x93NUMPY\x01\x00", 8);
  file.put(static_cast<char>(header.size() & 0xff)).put(static_cast<char>(header.size() >> 8));
  file << header;
  for (Eigen::Index row = 0; row < heights.rows() && !interrupted(); ++row)
    file.write(reinterpret_cast<const char*>(heights.row(row).data()),
               static_cast<std::streamsize>(sizeof(double)) * heights.cols());
  return !interrupted();
}

bool write_esri_grid(std::ostream& file, const HeightGrid& heights, double cell_size) {
  constexpr int no_data = -9999;
  const auto out = std::ostreambuf_iterator<char>(file);
  fmt::format_to(out, "ncols {}\nnrows {}\nxllcorner {}\nyllcorner {}\ncellsize {}\nNODATA_value {}\n",
                 heights.cols(), heights.rows(), -0.5 * cell_size * static_cast<double>(heights.cols()),
                 -0.5 * cell_size * static_cast<double>(heights.rows()), cell_size, no_data);
  for (Eigen::Index row = heights.rows() - 1; row >= 0 && !interrupted(); --row)
    for (Eigen::Index col = 0; col < heights.cols(); ++col)
      fmt::format_to(out, "{}{}", std::isnan(heights(row, col)) ? no_data : heights(row, col),
                     col + 1 < heights.cols() ? ' ' : '\n');
  return !interrupted();
}

}  // namespace

const GridFormat npy_format{{"a NumPy array"}, [](double cells) { return 128.0 + 8.0 * cells; }, write_npy};
const GridFormat esri_grid_format{
    {"an ESRI ASCII grid"}, [](double cells) { return 128.0 + 24.0 * cells; }, write_esri_grid};

}  // namespace sandstroke
