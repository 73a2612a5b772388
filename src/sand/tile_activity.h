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
  /// tells_givers: also say which cells may give, those within one of a change, for a stepper that holds all
  /// other sand still.
  explicit TileActivity(bool tells_givers) : tells_givers_(tells_givers) {}

  /// Takes up which cells are disturbed, and clears that (HeightField::clear_disturbed). The first time it
  /// wakes every allocated tile, and allocates those whose rule allows a slope above stable_slope (rise over
  /// run) and wakes them.
  void wake_disturbed(HeightField& bed, double stable_slope);

  /// Slots of the tiles with active cells. All tiles that an active cell can see are allocated.
  const std::vector<int>& tiles() const { return tiles_; }
  const CellFlags& cells(int slot) const { return marks_[slot].active; }

  /// Next active: all cells within two of those that changed. changed[i] belongs to tiles()[i] and counts
  /// where any_changed[i].
  void advance(HeightField& bed, const std::vector<CellFlags>& changed, const std::vector<char>& any_changed);

  /// Nothing is active any more.
  void rest();

  /// Cells of a tile that may give.
  const CellFlags& givers(int slot) const {
    static constexpr CellFlags none{};
    return static_cast<std::size_t>(slot) < marks_.size() ? marks_[slot].givers : none;
  }

  static constexpr std::size_t bytes_per_tile() { return sizeof(Marks); }
  /// How often a tile at rest became active, since construction.
  std::int64_t wake_ups() const { return wake_ups_; }

 private:
  /// Wakes all cells within two of the flagged ones.
  void wake_around(HeightField& bed, int slot, const CellFlags& changed);
  /// Flags rows [row_begin, row_begin + count) of a tile; those outside the bed are left out.
  void wake(HeightField& bed, int tile, int row_begin, const std::uint64_t* active,
            const std::uint64_t* givers, int count);
  void make_seen_tiles(HeightField& bed);

  struct Marks {
    CellFlags active{}, givers{};
    bool listed = false;      // in tiles_
    bool was_active = false;  // in tiles_before_
  };

  bool tells_givers_;
  std::vector<Marks> marks_;  // per slot
  std::vector<int> tiles_;
  std::vector<int> tiles_before_;  // during advance(): tiles_ of the pass before
  std::int64_t wake_ups_ = 0;
  bool first_time_ = true;
};

}  // namespace sandstroke
