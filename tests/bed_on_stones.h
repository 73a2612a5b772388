#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "sand/ground.h"

namespace sandstroke {

/// Sand level at 0 on a ground with half a sphere [m] whose centre is in the middle of the bed at this height
/// [m]. bottom [m]: a level floor under all of it; -infinity: there is none.
inline HeightField sand_with_a_stone(int rows, int cols, double cell_size, double radius,
                                     double centre_z = 0.0,
                                     double bottom = -std::numeric_limits<double>::infinity()) {
  HeightField bed(rows, cols, cell_size);
  constexpr double slope = 0.6;
  auto ground = std::make_shared<Ground>(bed, bottom, slope);
  for (int row = 0; row < rows; ++row)
    for (int col = 0; col < cols; ++col) {
      const double x = bed.x_of(col), y = bed.y_of(row), square = radius * radius - x * x - y * y;
      if (square > 0.0) ground->floor.set(row, col, std::max(bottom, centre_z + std::sqrt(square)));
    }
  bed.lie_on(ground);
  return bed;
}

}  // namespace sandstroke
