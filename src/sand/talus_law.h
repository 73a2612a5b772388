#pragma once

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

  TalusLaw(const RelaxationSettings& settings, double cell_size);
};

/// Where no slope (rise over run) is above this, both laws leave all sand at rest: they compare slopes along
/// rows, columns and diagonals; the isotropic one adds up two of them.
double stable_slope(const TalusLaw& law, double cell_size);

std::unique_ptr<Relaxer> make_tile_relaxer(const RelaxationSettings& settings, double cell_size);
/// What make_rkl_relaxer takes besides ActiveSand.
std::size_t rkl_bytes_per_tile();
std::unique_ptr<Relaxer> make_rkl_relaxer(const RelaxationSettings& settings, double cell_size);

}  // namespace sandstroke
