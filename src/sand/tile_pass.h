#pragma once

#include <array>
#include <vector>

#include "sand/talus_law.h"

namespace sandstroke {

/// One relaxation pass over one tile: reads the tile with a rim of two cells around it, writes only its own
/// next heights. So tiles can be done in any order, on any thread, with the same bits.
class TilePass {
 public:
  static constexpr int side = HeightField::tile_side;
  static constexpr int rim = 2;  ///< inflow comes from one cell away, whose share depends on one cell further
  static constexpr int stride = side + 2 * rim;

  /// Each thread has one, so that its memory is made once and shared with nobody.
  static TilePass& of_this_thread();

  /// What a pass did to a tile.
  struct Result {
    bool changed = false;  ///< some height in the tile is another number now
    bool top = false, bottom = false, left = false,
         right = false;  ///< ... within `rim` cells of that border (row 0 is top)
    double moved = 0.0;  ///< m: sum of what the tile's cells gave
  };

  /// next: tile_area heights; complete only if the result says `changed`.
  Result run(const TalusLaw& law, const HeightField& bed, int tile, std::vector<double>& next);

  /// Residual of a tile's cells as they are.
  double residual(const TalusLaw& law, const HeightField& bed, int tile);

 private:
  TilePass();
  void load(const HeightField& bed, int tile);
  bool paper_factors(int row);
  bool isotropic_factors(int row);
  template <bool diagonals>
  double exchange_row(int row, double* next) const;

  const TalusLaw* law_ = nullptr;  // of the call that is going on
  std::vector<double>
      heights_;  // stride x stride; NaN outside the bed: every comparison with a wall is false
  std::vector<double> factors_;  // same shape; the part of each drop that a cell gives away
  std::array<bool, stride> row_moves_{};
};

}  // namespace sandstroke
