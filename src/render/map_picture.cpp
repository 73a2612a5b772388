#include "render/map_picture.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "render/annotate.h"
#include "render/colour_map.h"

namespace sandstroke {

Image plain_map(const HeightGrid& values, double low, double high, bool diverging, int width, int height) {
  const auto rows = static_cast<double>(values.rows()), cols = static_cast<double>(values.cols());
  // Cells of pixel k of `pixels`: [first, last), at least one.
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
      const Rgb rgb = as_bytes(scale_colour(std::isfinite(mean) ? mean : std::nan(""), low, high, diverging));
      std::copy(rgb.begin(), rgb.end(), map.pixel(x, y));
    }
  }
  return map;
}

Image map_picture(const HeightGrid& values, double low, double high, bool diverging, int width, int height,
                  std::string_view quantity) {
  Image image(width, height);
  std::fill(image.rgb.begin(), image.rgb.end(), std::uint8_t{246});
  const Legend legend{std::string(quantity), low, high, diverging, 0.0};

  const double margin = annotation_cap_height(height);
  const double room_x = width - legend_width(legend, height) - 2.0 * margin, room_y = height - 2.0 * margin;
  const auto rows = static_cast<double>(values.rows()), cols = static_cast<double>(values.cols());
  const double scale = std::min(room_x / cols, room_y / rows);  // pixels per cell
  const int map_width = std::max(1, static_cast<int>(cols * scale));
  const int map_height = std::max(1, static_cast<int>(rows * scale));
  const int left = static_cast<int>(margin + 0.5 * (room_x - map_width));
  const int top = static_cast<int>(margin + 0.5 * (room_y - map_height));

  const Image map = plain_map(values, low, high, diverging, map_width, map_height);
  for (int y = std::max(0, -top); y < std::min(map_height, height - top); ++y)
    for (int x = std::max(0, -left); x < std::min(map_width, width - left); ++x)
      std::copy_n(map.pixel(x, y), 3, image.pixel(left + x, top + y));
  draw_legend(image, legend);
  return image;
}

}  // namespace sandstroke
