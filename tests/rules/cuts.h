#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "core/angle.h"
#include "rules/standing.h"

namespace sandstroke::cuts {

// Cuts and towers of moist sand of cohesion 1 c / gamma: lengths are in that unit. Heights at which they fail
// are found by bisection.

inline constexpr double friction_angle = 33.0;

struct Sand {
  HeightGrid heights, floor, cohesion;
  WallGrid walls;
  double cell;

  Sand(int side, double cell_size)
      : heights(HeightGrid::Zero(side, side)),
        floor(HeightGrid::Constant(side, side, -std::numeric_limits<double>::infinity())),
        cohesion(HeightGrid::Ones(side, side)),
        walls(WallGrid::Constant(side, side, false)),
        cell(cell_size) {}
  /// height(x, y), from the middle.
  void lay(const std::function<double(double, double)>& height) {
    const double middle = 0.5 * static_cast<double>(heights.rows());
    for (int row = 0; row < heights.rows(); ++row)
      for (int col = 0; col < heights.cols(); ++col)
        heights(row, col) = height((col + 0.5 - middle) * cell, (row + 0.5 - middle) * cell);
  }
  CutsLook look(const CohesionFactor& factor) const {
    return look_at_cuts(heights, heights, floor, cohesion, walls, factor, cell);
  }
};

/// The height up to which sand stands, by bisection between two heights that `fails` tells apart.
inline double critical(double low, double high, int steps, const std::function<bool(double)>& fails) {
  for (int i = 0; i < steps; ++i) {
    const double middle = 0.5 * (low + high);
    (fails(middle) ? high : low) = middle;
  }
  return 0.5 * (low + high);
}

/// The height [c / gamma] at which a slab of this width slides off along a plane through its foot, or a cut
/// does: min over T of (1 + T^2) / (T - mu) + width T / 2, where the plane leaves through the far side.
inline double height_of_slab(double width, double of_cut) {
  const double mu = std::tan(to_radians(friction_angle));
  double least = of_cut;
  for (double T = mu + 1e-3; T < 60.0; T += 1e-3) {
    const double height = (1.0 + T * T) / (T - mu) + 0.5 * width * T;
    if (width * T <= height) least = std::min(least, height);
  }
  return least;
}

/// The height at which a round tower of this width fails, in so many cells per height of a cut.
inline double height_of_tower(const CohesionFactor& factor, double width, double of_cut, int cells) {
  return critical(0.3 * of_cut, 1.3 * of_cut, 10, [&](double height) {
    Sand sand(static_cast<int>((width / of_cut + 0.9) * cells), of_cut / cells);
    sand.lay([&](double x, double y) { return std::hypot(x, y) < 0.5 * width ? height : 0.0; });
    return sand.look(factor).failed > 0;
  });
}

}  // namespace sandstroke::cuts
