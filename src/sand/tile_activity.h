#pragma once

#include <vector>

#include "sand/cell_flags.h"
#include "sand/height_field.h"

namespace sandstroke {

/// Which cells of a bed may change in the coming pass. What a cell does in a pass depends on cells up to two
/// away (its neighbours' shares depend on theirs), so it can change only if one of those changed in the pass
/// before, or was set from outside. Flags cross borders and corners of tiles, so the pattern does not depend
/// on tiles at all.
class TileActivity {
 public:
  /// Takes up what was set since the last call and forgets it (HeightField::settle). The first time: every
  /// tile that exists, and those whose rule allows a slope above stable_slope (rise over run), which come
  /// into being.
  void wake_disturbed(HeightField& bed, double stable_slope);

  /// Slots of the tiles with active cells. All tiles that an active cell can see exist.
  const std::vector<int>& tiles() const { return tiles_; }
  const CellFlags& cells(int slot) const { return active_[slot]; }
  std::int64_t cell_count() const;

  /// Next active: all cells within two of those that changed. changed[i] belongs to tiles()[i] and counts
  /// where any_changed[i].
  void advance(HeightField& bed, const std::vector<CellFlags>& changed, const std::vector<char>& any_changed);

  /// Makes a tile's flagged cells active besides those that are.
  void add(HeightField& bed, int slot, const CellFlags& cells);

  /// How often a tile at rest became active, since construction.
  std::int64_t wake_ups() const { return wake_ups_; }

 private:
  /// Wakes all cells within two of the flagged ones.
  void wake_around(HeightField& bed, int slot, const CellFlags& changed);
  void wake(HeightField& bed, int tile, int row_begin, const std::uint64_t* rows, int count);
  void make_seen_tiles(HeightField& bed);

  std::vector<int> tiles_;
  std::vector<CellFlags> active_;  // per slot
  std::vector<char> listed_;       // per slot: in tiles_
  std::vector<char> was_active_;   // per slot: in tiles_before_
  std::vector<int> tiles_before_;  // during advance(): tiles_ of the pass before
  std::int64_t wake_ups_ = 0;
  bool first_time_ = true;
};

}  // namespace sandstroke
