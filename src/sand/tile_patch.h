#pragma once

#include <array>

#include "sand/cell_flags.h"
#include "sand/height_field.h"

namespace sandstroke {

/// A tile's heights with a rim of two cells around them, as a relaxation pass reads them, and the pass's
/// scratch. Row r of the tile (-2 ... tile_side + 1) begins with column 0 on a 64-byte boundary.
class TilePatch {
 public:
  static constexpr int side = BedGeometry::tile_side;
  static constexpr int rim = 2;  ///< inflow comes from one cell away, whose share depends on one cell further
  static constexpr int margin = cells_per_group;  ///< doubles before column 0 and after the last
  static constexpr int stride = side + 2 * margin;

  TilePatch();
  /// Each thread has one, so that its memory is made once and shared with nobody.
  static TilePatch& of_this_thread();

  /// Loads the rows and columns that the flagged cells' next heights depend on, whole groups of 8 with all
  /// that their cells compare with; the tiles that they lie in must exist. Outside the bed, where no tile
  /// exists, and where the bed holds them, cells are NaN: every comparison with them is false. The rest keeps
  /// what an earlier tile left there, but for the margins beyond the rim: those are NaN for ever.
  void load(const HeightField& bed, int slot, const CellFlags& cells);

  double* heights(int row) { return heights_.data() + start(row); }
  const double* heights(int row) const { return heights_.data() + start(row); }
  /// The part of each drop that a cell gives away.
  double* factors(int row) { return factors_.data() + start(row); }
  const double* factors(int row) const { return factors_.data() + start(row); }

 private:
  static constexpr int rows = side + 2 * rim;
  static constexpr int size = rows * stride + 2 * margin;  // vectors reach a double beyond the margins
  static int start(int row) { return margin + (row + rim) * stride + margin; }

  alignas(64) std::array<double, size> heights_;
  alignas(64) std::array<double, size> factors_;
};

}  // namespace sandstroke
