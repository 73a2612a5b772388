#include "render/tile_detail.h"

#include <algorithm>
#include <cmath>

namespace sandstroke {

TileDetail tile_detail(const DrawnHeights& heights, const CellRange& patch) {
  const int rows = patch.rows(), cols = patch.cols();
  const auto cells = heights.block(patch.row_begin, patch.col_begin, rows, cols);
  TileDetail detail;
  detail.lowest = static_cast<double>(cells.minCoeff());
  detail.highest = static_cast<double>(cells.maxCoeff());
  if (detail.lowest == detail.highest) return detail;
  if (rows > 1 && cols > 1) {
    const auto corner = cells.topLeftCorner(rows - 1, cols - 1);
    const auto along_x = cells.topRightCorner(rows - 1, cols - 1) - corner;
    const auto along_y = cells.bottomLeftCorner(rows - 1, cols - 1) - corner;
    detail.steepest = std::sqrt(static_cast<double>((along_x.square() + along_y.square()).maxCoeff()));
  }
  for (int level = 1; level <= coarsest_level; ++level) {
    const int side = 1 << level;
    float worst = 0.0f;
    for (int row = 0; row < rows; ++row) {
      const int r0 = row / side * side, r1 = std::min(r0 + side, rows - 1);
      const float v = r1 > r0 ? static_cast<float>(row - r0) / static_cast<float>(r1 - r0) : 0.0f;
      for (int c0 = 0; c0 < cols; c0 += side) {
        const int c1 = std::min(c0 + side, cols - 1);
        const float left = cells(r0, c0) + v * (cells(r1, c0) - cells(r0, c0));
        const float right = cells(r0, c1) + v * (cells(r1, c1) - cells(r0, c1));
        const float slope = c1 > c0 ? (right - left) / static_cast<float>(c1 - c0) : 0.0f;
        for (int col = c0; col < c1; ++col)
          worst = std::max(worst, std::abs(left + slope * static_cast<float>(col - c0) - cells(row, col)));
      }
    }
    detail.error[level] = std::max(detail.error[level - 1], static_cast<double>(worst));
  }
  return detail;
}

double skirt_bottom(const TileDetail& detail, double cell_size) { return detail.lowest - cell_size; }

int level_of_detail(const TileDetail& detail, double cell_size, double pixels_per_metre) {
  constexpr double longest = 3.0, largest_error = 0.33;  // pixels
  int level = 0;
  while (level < coarsest_level && (cell_size * (2 << level) * pixels_per_metre <= longest ||
                                    detail.error[level + 1] * pixels_per_metre <= largest_error))
    ++level;
  return level;
}

}  // namespace sandstroke
