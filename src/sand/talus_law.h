#pragma once

#include <cmath>
#include <numbers>

#include "sand/relaxation.h"

namespace sandstroke {

/// Which slopes are too steep, as height differences [m] between neighbours, the form both laws compute with.
struct TalusLaw {
  RelaxationLaw law;
  double share;          ///< c
  double axis_drop;      ///< T of an axis neighbour: tan(talus) dx
  double diagonal_drop;  ///< T of a diagonal neighbour: tan(talus) sqrt(2) dx
  double axis_limit;     ///< above these a cell moves: T (1 + tolerance)
  double diagonal_limit;

  TalusLaw(const RelaxationSettings& settings, double cell_size)
      : law(settings.law),
        share(flow_share(settings)),
        axis_drop(talus_slope(settings.talus_angle) * cell_size),
        diagonal_drop(axis_drop * std::numbers::sqrt2),
        axis_limit(axis_drop * (1.0 + settings.tolerance)),
        diagonal_limit(diagonal_drop * (1.0 + settings.tolerance)) {}
};

/// Where no slope (rise over run) is above this, the law leaves all sand at rest. Laws compare slopes along
/// rows, columns and diagonals; isotropic adds up two of them, faces 4/3 of one (M + M / 3) and another.
inline double stable_slope(const TalusLaw& law, double cell_size) {
  const double added = law.law == RelaxationLaw::faces ? 5.0 / 3.0 : std::numbers::sqrt2;
  return law.axis_drop / cell_size / added * (1.0 - 1e-9);
}

}  // namespace sandstroke
