#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "sand/cell_flags.h"
#include "sand/height_field.h"

namespace sandstroke {

/// The active cells that may give sand: all, or only those within one of a change. The latter are tracked,
/// too.
enum class Givers { all, near_changes };

/// Tracks which cells of a bed may change in the next pass. What a cell does in a pass depends on cells up to
/// two away (its neighbours' flows depend on their neighbours). So it can change only if one of those changed
/// in the pass before, or was set from outside. Flags cross borders and corners of tiles, so the pattern does
/// not depend on tiles at all.
class TileActivity {
 public:
  explicit TileActivity(Givers givers) : tells_givers_(givers == Givers::near_changes) {}

  /// Cells of a tile that changed; all in these rows.
  struct Changed {
    const CellFlags& cells;
    RowSpan rows;
  };
  /// Wakes all cells within two of the changed ones. Then call wake_disturbed().
  void wake_around(HeightField& bed, int slot, const Changed& changed);
  /// Wakes the cells around the disturbed ones, and clears these (HeightField::clear_disturbed).
  void wake_disturbed(HeightField& bed);

  /// Slots of the tiles with active cells. All tiles that an active cell can see are allocated.
  const std::vector<int>& tiles() const { return tiles_; }
  const CellFlags& cells(int slot) const { return marks_[slot]->active; }
  RowSpan rows(int slot) const { return marks_[slot]->rows; }  ///< rows with active cells
  /// Cells that were active at some time since look_away(), or would have been if they were no walls.
  const CellFlags& seen(int slot) const { return marks_[slot]->seen; }
  void look_away(int slot) { marks_[slot]->seen = {}; }

  /// Makes the cells active that lie within two of those that changed. changed(slot) tells these, for each of
  /// tiles().
  template <class ChangedIn>
  void advance(HeightField& bed, const ChangedIn& changed) {
    std::swap(tiles_before_, tiles_);
    for (const int slot : tiles_before_) {
      marks_[slot]->sleep();
      marks_[slot]->was_active = true;
    }
    tiles_.clear();
    for (const int slot : tiles_before_) wake_around(bed, slot, changed(slot));
    for (const int slot : tiles_before_) marks_[slot]->was_active = false;
    make_seen_tiles(bed);
  }

  /// Nothing is active any more.
  void rest();

  /// Cells of a tile that may give.
  const CellFlags& givers(int slot) const {
    static constexpr CellFlags none{};
    return static_cast<std::size_t>(slot) < marks_.size() && marks_[slot] ? marks_[slot]->givers : none;
  }

  void visit_state(StateVisitor& state);

  static constexpr std::size_t bytes_per_tile() { return sizeof(Marks) + sizeof(std::unique_ptr<Marks>); }
  /// How often a tile at rest became active, since construction.
  std::int64_t wake_ups() const { return wake_ups_; }

 private:
  /// Flags cells in rows [row_begin, row_begin + count) of a tile, except cells outside the bed and walls,
  /// which never change.
  void wake(HeightField& bed, int tile, int row_begin, const std::uint64_t* active,
            const std::uint64_t* givers, int count);
  void make_seen_tiles(HeightField& bed);

  struct Marks {
    CellFlags active{}, givers{}, seen{};
    RowSpan rows;             // rows that hold the flags of active and givers
    bool listed = false;      // in tiles_
    bool was_active = false;  // in tiles_before_

    template <class State>
    void visit_state(State& state) {
      state.value("active", active);
      state.value("givers", givers);
      state.value("seen", seen);
      state.value("rows.begin", rows.begin);
      state.value("rows.end", rows.end);
      state.value("listed", listed);
    }
    void sleep() {
      for (int row = rows.begin; row < rows.end; ++row) active[row] = givers[row] = 0;
      rows = {};
      listed = false;
    }
  };

  /// By slot; none while nothing was awake there. A copy has those of tiles that are awake.
  class MarksBySlot : public std::vector<std::unique_ptr<Marks>> {
   public:
    MarksBySlot() = default;
    MarksBySlot(const MarksBySlot& other) : vector() {
      for (std::size_t slot = 0; slot < other.size(); ++slot)
        if (other[slot] && other[slot]->listed) make(slot) = *other[slot];
    }
    MarksBySlot(MarksBySlot&&) noexcept = default;
    MarksBySlot& operator=(const MarksBySlot& other) { return *this = MarksBySlot(other); }
    MarksBySlot& operator=(MarksBySlot&&) noexcept = default;

    Marks& make(std::size_t slot) {
      if (size() <= slot) resize(slot + 1);
      if (!(*this)[slot]) (*this)[slot] = std::make_unique<Marks>();
      return *(*this)[slot];
    }
  };

  bool tells_givers_;
  MarksBySlot marks_;
  std::vector<int> tiles_;
  std::vector<int> tiles_before_;  // during advance(): tiles_ of the pass before
  std::int64_t wake_ups_ = 0;
};

}  // namespace sandstroke
