#pragma once

#include <numbers>

#include "rules/talus.h"
#include "sand/height_field.h"

namespace sandstroke {

/// The slope (rise over run) up to which the law leaves all sand at rest. Laws compare slopes along rows,
/// columns and diagonals. isotropic combines two of them; faces combines 4/3 of one (M + M / 3) with another.
inline double stable_slope(const TalusLaw& law, double cell_size) {
  const double added = law.law == RelaxationLaw::faces ? 5.0 / 3.0 : std::numbers::sqrt2;
  return law.axis_drop / cell_size / added * (1.0 - 1e-9);
}

/// Calls visit(tile) for the tiles whose rule allows a slope (rise over run) above `slope`, between their own
/// cells or to a neighbouring tile's.
template <class Visit>
void visit_steep_tiles(const HeightField& bed, double slope, const Visit& visit) {
  visit_quarters({0, bed.tile_rows(), 0, bed.tile_cols()}, [&](const CellRange& tiles) {
    const CellRange own = bed.cells_of_tiles(tiles);
    const CellRange seen = {std::max(own.row_begin - 1, 0), std::min(own.row_end + 1, bed.rows()),
                            std::max(own.col_begin - 1, 0), std::min(own.col_end + 1, bed.cols())};
    if (bed.untouched().steepest(bed, seen) <= slope) return false;
    if (tiles.rows() == 1 && tiles.cols() == 1) visit(bed.tile_index(tiles.row_begin, tiles.col_begin));
    return true;
  });
}

}  // namespace sandstroke
