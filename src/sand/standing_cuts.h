#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "core/state_visitor.h"
#include "rules/standing.h"
#include "sand/block_ranges.h"
#include "sand/cell_flags.h"
#include "sand/height_field.h"

namespace sandstroke {

/// The cohesion of moist sand over its weight per volume, c / gamma [m], by place.
struct Cohesion {
  double least = 0.0;                                     ///< of all places
  std::shared_ptr<const HeightField> by_place = nullptr;  ///< null: it is the same everywhere
  double dried = 0.0;                                     ///< m, that all places have lost of it

  double at(int row, int col) const {
    return std::max(0.0, (by_place ? (*by_place)(row, col) : least) - dried);
  }
};

/// The intact level of a bed of moist sand, and which of its cuts fail (rules/standing.h): the same bits as
/// look_at_cuts, but only where something changed, and where the sand is high enough to fail.
class StandingCuts {
 public:
  /// All sand is intact.
  StandingCuts(const HeightField& bed, const CohesionFactor& factor);

  /// The level b [m], nowhere above the sand.
  const HeightField& level() const { return level_; }
  /// Whether cohesion [m] carries no more than the step of a cell at mu: as good as none.
  bool is_dry(double cohesion) const {
    return cohesion * factor_.safe_height() <= factor_.friction() * level_.cell_size();
  }
  /// Lowers the level to the sand where that was set (HeightField::disturbed_tiles), and under all sand where
  /// the cohesion is as good as none. What was intact there until now may flow: it is marked as disturbed.
  void cut(HeightField& bed, const Cohesion& cohesion);
  /// The sand as it lies is intact, but where the cohesion is as good as none.
  void heal(HeightField& bed, const Cohesion& cohesion);
  /// The level is that of another bed's, but nowhere above this one's sand.
  void take_over(const StandingCuts& other, const HeightField& bed);

  struct Look {
    std::int64_t tiles = 0;   ///< whose cells were looked at
    std::int64_t toes = 0;    ///< cells beside a face that could fail
    std::int64_t failed = 0;  ///< those whose wedge fails
    double volume = 0.0;      ///< m^3, by which the level sank
  };
  /// Looks at the toes whose rays may have come to other sand, or other cohesion, since the last look. Lowers
  /// the level where wedges fail, and marks these cells of the bed as disturbed.
  Look look(HeightField& bed, const Cohesion& cohesion);

  void visit_state(StateVisitor& state);

 private:
  /// A toe whose wedge fails.
  struct Failure {
    int row, col;
    double toe;  // m
    Uphill uphill;
    Wedge wedge;
  };
  void cut_tile(const HeightField& bed, int slot, const CellFlags& cells);
  void free_dry_sand(HeightField& bed, const Cohesion& cohesion);
  void know_ranges(const HeightField& bed);
  /// Funnels are those of the cells. Between them sand may reach in, and chords begin at a face's foot, up to
  /// half a cell further.
  double spare() const { return 2.5 * factor_.friction() * level_.cell_size(); }
  /// A tile to look at, by index.
  struct TileToLookAt {
    int tile;
    std::uint64_t blocks;  // whose wedges may fail (Funnels::below)
    double top;            // m: no sand that its rays may come to is higher
    CellRange rays;        // the cells that they may come to
  };
  struct WhereToLook {
    std::vector<TileToLookAt> tiles = {};
    std::optional<Funnels> funnels = {};  // if there are tiles
    double highest_floor = 0.0;           // m
  };
  /// least: of the cohesion over the weight per volume [m].
  WhereToLook where_to_look(const HeightField& bed, double least, bool everywhere);
  /// The run [m] beyond which no wedge of a toe fails. above, top [m]: as in CohesionFactor::longest_run,
  /// that is, with no floor above the toe.
  double longest_run(double toe, double above, double top, double highest_floor, double least) const {
    return highest_floor > toe ? (top - toe) / factor_.friction()
                               : factor_.longest_run(above, top - toe, least);
  }
  /// before: the level as it is.
  void lower(const HeightField& bed, const HeightField& before, const std::vector<Failure>& failures);

  CohesionFactor factor_;
  HeightField level_;
  static constexpr std::uint64_t never = BlockRanges::never;
  std::vector<BlockRanges> ranges_;  // by tile
  std::vector<std::uint64_t> seen_;  // by tile: the bed's revision in the last look; never: look again
  std::vector<int> dry_tiles_;       // by index, that have dry sand beside moist sand
  double dry_since_ = -1.0;          // m, dried when they were found; below 0: never
  double dried_ = 0.0;               // m, in the last look
};

}  // namespace sandstroke
