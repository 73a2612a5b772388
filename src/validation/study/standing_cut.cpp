#include "validation/study/standing_cut.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/angle.h"

namespace sandstroke {

double height_error(const StandingCut& cut, SlipSurface surface) {
  const CohesionFactor factor(surface, cut.friction);
  const double exact = critical_height(surface, cut.face, cut.friction), cell = exact / cut.cells,
               across = std::cos(to_radians(cut.turn)), up = std::sin(to_radians(cut.turn)),
               slope = std::tan(to_radians(cut.face));
  constexpr int strip = 6;  // cells, half of what is looked at
  const double run = 1.6 * exact / std::tan(to_radians(0.5 * (cut.face + cut.friction)));  // of a wedge
  const int half = static_cast<int>(run / cell) + strip + 2, side = 2 * half;
  HeightGrid heights(side, side);
  const HeightGrid floor = HeightGrid::Constant(side, side, -std::numeric_limits<double>::infinity()),
                   cohesion = HeightGrid::Ones(side, side);
  const auto fails = [&](double height) {
    WallGrid walls = WallGrid::Constant(side, side, true);
    for (int row = 0; row < side; ++row)
      for (int col = 0; col < side; ++col) {
        const double along = ((col + 0.5 - half) * across + (row + 0.5 - half) * up + cut.shift) * cell;
        heights(row, col) =
            cut.face == 90.0 ? (along > 0.0 ? height : 0.0) : std::clamp(along * slope, 0.0, height);
        const bool in_middle = std::abs(row + 0.5 - half) < strip && std::abs(col + 0.5 - half) < strip;
        if (in_middle && heights(row, col) < 0.2 * height) walls(row, col) = false;
      }
    return look_at_cuts(heights, heights, floor, cohesion, walls, factor, cell).failed > 0;
  };
  double low = 0.8, high = 1.35;
  while (high - low > 5e-4) {
    const double middle = 0.5 * (low + high);
    (fails(middle * exact) ? high : low) = middle;
  }
  return 0.5 * (low + high) - 1.0;
}

}  // namespace sandstroke
