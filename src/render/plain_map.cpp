#include "render/plain_map.h"

#include <algorithm>
#include <cmath>

#include "render/colour_map.h"

namespace sandstroke {

Image plain_map(const HeightGrid& values, double low, double high, ColourScale scale, int width, int height) {
  const auto rows = static_cast<double>(values.rows()), cols = static_cast<double>(values.cols());
  // The cells of pixel k of `pixels` pixels: [first, last), at least one.
  const auto first = [](int k, int pixels, double cells) {
    return static_cast<Eigen::Index>(k * cells / pixels);
  };
  const auto last = [&](int k, int pixels, double cells) {
    return std::max(first(k, pixels, cells) + 1, first(k + 1, pixels, cells));
  };
  Image map(width, height);
  for (int y = 0; y < height; ++y) {
    const int up = height - 1 - y;
    const Eigen::Index row = first(up, height, rows), row_count = last(up, height, rows) - row;
    for (int x = 0; x < width; ++x) {
      const Eigen::Index col = first(x, width, cols), col_count = last(x, width, cols) - col;
      const double mean = values.block(row, col, row_count, col_count).mean();
      const Rgb rgb = as_bytes(scale_colour(std::isfinite(mean) ? mean : std::nan(""), low, high, scale));
      std::copy(rgb.begin(), rgb.end(), map.pixel(x, y));
    }
  }
  return map;
}

}  // namespace sandstroke
