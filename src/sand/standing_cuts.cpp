#include "sand/standing_cuts.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <utility>

#include "core/parallel.h"
#include "sand/cell_ranges.h"
#include "sand/ground.h"

namespace sandstroke {
namespace {

/// Heights and intact levels of a rectangle of cells, as the rule asks for them.
class Window {
 public:
  Window(const HeightField& bed, const HeightField& level, const Cohesion& cohesion, double highest_floor,
         const CellRange& cells)
      : bed_(bed),
        cohesion_(cohesion),
        highest_floor_(highest_floor),
        cells_(cells),
        columns_(std::make_unique_for_overwrite<Column[]>(index(cells.row_end, cells.col_begin))) {
    const std::ptrdiff_t cols = cells.cols();
    std::vector<double> heights(cols), levels(cols);
    for (int row = cells.row_begin; row < cells.row_end; ++row) {
      const CellRange one{row, row + 1, cells.col_begin, cells.col_end};
      bed.read_cells(one, heights.data(), cols);
      level.read_cells(one, levels.data(), cols);
      Column* out = &columns_[index(row, cells.col_begin)];
      for (std::ptrdiff_t i = 0; i < cols; ++i) out[i] = {heights[i], levels[i]};
    }
  }

  int rows() const { return bed_.rows(); }
  int cols() const { return bed_.cols(); }
  double cell_size() const { return bed_.cell_size(); }
  bool is_rectangle() const { return bed_.shape() == BedShape::rectangle; }
  double highest_floor() const { return highest_floor_; }
  bool is_uniform() const { return !cohesion_.by_place; }
  bool has_sand(int row, int col) const {
    return row >= cells_.row_begin && row < cells_.row_end && col >= cells_.col_begin &&
           col < cells_.col_end && (is_rectangle() || bed_.has_sand(row, col));
  }
  double height(int row, int col) const { return columns_[index(row, col)].height; }
  double intact(int row, int col) const { return columns_[index(row, col)].intact; }
  double floor(int row, int col) const { return bed_.floor(row, col); }
  double cohesion(int row, int col) const { return cohesion_.at(row, col); }

 private:
  std::size_t index(int row, int col) const {
    return static_cast<std::size_t>(row - cells_.row_begin) * cells_.cols() +
           static_cast<std::size_t>(col - cells_.col_begin);
  }

  const HeightField& bed_;
  const Cohesion& cohesion_;
  double highest_floor_;
  CellRange cells_;
  struct Column {
    double height, intact;  // m
  };
  std::unique_ptr<Column[]> columns_;
};

/// The tiles within so many of a tile, by tile rows and columns.
CellRange tiles_around(const HeightField& bed, int tile, int reach) {
  const int row = tile / bed.tile_cols(), col = tile % bed.tile_cols();
  return common(grown({row, row + 1, col, col + 1}, reach), {0, bed.tile_rows(), 0, bed.tile_cols()});
}

double area(const CellRange& cells) { return static_cast<double>(cells.rows()) * cells.cols(); }

/// The cells of a block of a tile.
CellRange cells_of_block(const CellRange& tile, int at) {
  constexpr int block = BlockRanges::block, side = BlockRanges::side;
  const int row = tile.row_begin + at / side * block, col = tile.col_begin + at % side * block;
  return common({row, row + block, col, col + block}, tile);
}

/// The greatest of the values, by tile, within so many tiles of each.
std::vector<double> greatest_near(const HeightField& bed, const std::vector<double>& values, int reach) {
  std::vector<double> along(values), both(values);
  for (int tile = 0; tile < bed.tile_count(); ++tile) {
    const CellRange near = tiles_around(bed, tile, reach);
    for (int col = near.col_begin; col < near.col_end; ++col)
      along[tile] = std::max(along[tile], values[bed.tile_index(tile / bed.tile_cols(), col)]);
  }
  for (int tile = 0; tile < bed.tile_count(); ++tile) {
    const CellRange near = tiles_around(bed, tile, reach);
    both[tile] = along[tile];
    for (int row = near.row_begin; row < near.row_end; ++row)
      both[tile] = std::max(both[tile], along[bed.tile_index(row, tile % bed.tile_cols())]);
  }
  return both;
}

}  // namespace

StandingCuts::StandingCuts(const HeightField& bed, const CohesionFactor& factor)
    : factor_(factor), level_(bed), ranges_(bed.tile_count()), seen_(bed.tile_count(), never) {
  level_.lie_on(nullptr);
  level_.clear_disturbed();
}

void StandingCuts::cut(HeightField& bed, const Cohesion& cohesion) {
  for (const int slot : bed.disturbed_tiles()) cut_tile(bed, slot, bed.disturbed_cells(slot));
  if (cohesion.by_place || is_dry(cohesion.least - cohesion.dried)) free_dry_sand(bed, cohesion);
  level_.clear_disturbed();
}

void StandingCuts::free_dry_sand(HeightField& bed, const Cohesion& cohesion) {
  const bool dries = std::exchange(dry_since_, cohesion.dried) != cohesion.dried;
  if (dries) {
    dry_tiles_.clear();
    for (int tile = 0; tile < bed.tile_count(); ++tile) {
      const CellRange cells = bed.tile_cells(tile);
      bool has_dry = false;
      for (int row = cells.row_begin; row < cells.row_end && !has_dry; ++row)
        for (int col = cells.col_begin; col < cells.col_end && !has_dry; ++col)
          has_dry = is_dry(cohesion.at(row, col));
      if (has_dry) dry_tiles_.push_back(tile);
    }
  }
  know_ranges(bed);
  double low = ranges_[0].whole.low;
  for (const BlockRanges& range : ranges_) low = std::min(low, range.whole.low);
  const double deep = low - bed.cell_size();  // no flow gets there
  for (const int tile : dry_tiles_) {
    const CellRange cells = bed.tile_cells(tile);
    for (int row = cells.row_begin; row < cells.row_end; ++row)
      for (int col = cells.col_begin; col < cells.col_end; ++col) {
        const double level = std::max(deep, bed.floor(row, col));
        if (!(level < level_(row, col)) || !is_dry(cohesion.at(row, col))) continue;
        level_.set(row, col, level);
        if (dries)
          bed.mark_disturbed(bed.allocate(tile), row - cells.row_begin,
                             std::uint64_t{1} << (col - cells.col_begin));
      }
  }
}

void StandingCuts::take_over(const StandingCuts& other, const HeightField& bed) {
  level_ = other.level_;
  CellFlags all;
  all.fill(~std::uint64_t{0});
  for (int slot = 0; slot < bed.allocated_tiles(); ++slot) cut_tile(bed, slot, all);
  level_.clear_disturbed();
  std::fill(seen_.begin(), seen_.end(), never);
}

void StandingCuts::cut_tile(const HeightField& bed, int slot, const CellFlags& flags) {
  const CellRange cells = bed.tile_cells(bed.tile_of(slot));
  const double* heights = bed.tile_heights(slot);
  for (int row = 0; row < cells.rows(); ++row)
    for (std::uint64_t left = flags[row] & columns_between(0, cells.cols()); left; left &= left - 1) {
      const int col = std::countr_zero(left), r = cells.row_begin + row, c = cells.col_begin + col;
      const double height = heights[row * HeightField::tile_side + col];
      if (height < level_(r, c)) level_.set(r, c, height);
    }
}

void StandingCuts::heal(HeightField& bed, const Cohesion& cohesion) {
  if (!cohesion.by_place && is_dry(cohesion.least - cohesion.dried)) return;
  level_ = bed;
  level_.lie_on(nullptr);
  if (cohesion.by_place) free_dry_sand(bed, cohesion);
  level_.clear_disturbed();
}

void StandingCuts::know_ranges(const HeightField& bed) {
  for (int tile = 0; tile < bed.tile_count(); ++tile) ranges_[tile].know(bed, tile);
}

StandingCuts::WhereToLook StandingCuts::where_to_look(const HeightField& bed, double least, bool everywhere) {
  const double safe = factor_.safe_height() * least, per_cell = factor_.friction() * bed.cell_size();
  double low = ranges_[0].whole.low, high = ranges_[0].whole.high;
  std::vector<double> changed(bed.tile_count()), highs(bed.tile_count());
  bool any = false;
  for (int tile = 0; tile < bed.tile_count(); ++tile) {
    low = std::min(low, ranges_[tile].whole.low);
    high = std::max(high, ranges_[tile].whole.high);
    highs[tile] = ranges_[tile].whole.high;
    changed[tile] = everywhere || seen_[tile] != bed.tile_revision(tile) ? 1.0 : 0.0;
    any = any || changed[tile] > 0.0;
    seen_[tile] = bed.tile_revision(tile);
  }
  if (!any || high - low <= safe) return {};
  // A ray goes on until its chord would be flatter than mu, and a cell further; a face is looked for around.
  constexpr int beyond = standing::reach + 2;
  const int reach =
      static_cast<int>(std::min(std::ceil(((high - low) / per_cell + beyond) / BedGeometry::tile_side),
                                1.0 * std::max(bed.tile_rows(), bed.tile_cols())));
  const std::vector<double> top_near = greatest_near(bed, highs, reach),
                            changed_near = greatest_near(bed, changed, reach);
  const auto may_fail = [&](int tile) {
    return changed_near[tile] > 0.0 && top_near[tile] - ranges_[tile].whole.low > safe;
  };
  CellRange seen;
  for (int tile = 0; tile < bed.tile_count(); ++tile)
    if (may_fail(tile)) seen = around(seen, tiles_around(bed, tile, reach));
  if (seen.empty()) return {};
  WhereToLook where;
  where.funnels.emplace(bed, ranges_, seen, factor_.friction());
  where.highest_floor =
      bed.ground() ? bed.ground()->floor.highest() : -std::numeric_limits<double>::infinity();
  for (int tile = 0; tile < bed.tile_count(); ++tile) {
    if (!may_fail(tile)) continue;
    const Funnels::Below below = where.funnels->below(bed, tile, ranges_[tile], safe - spare());
    if (below.blocks == 0) continue;
    const double top = top_near[tile], toe = ranges_[tile].whole.low,
                 above = std::min(top - toe, below.most + spare()),
                 longest = longest_run(toe, above, top, where.highest_floor, least);
    CellRange rays;
    for (std::uint64_t left = below.blocks; left; left &= left - 1)
      rays = around(rays, cells_of_block(bed.tile_cells(tile), std::countr_zero(left)));
    rays = common(grown(rays, static_cast<int>(std::ceil(longest / bed.cell_size())) + beyond),
                  {0, bed.rows(), 0, bed.cols()});
    where.tiles.push_back({tile, below.blocks, top, rays});
  }
  return where;
}

StandingCuts::Look StandingCuts::look(HeightField& bed, const Cohesion& cohesion) {
  know_ranges(bed);
  const double least = std::max(0.0, cohesion.least - cohesion.dried), safe = factor_.safe_height() * least,
               mu = factor_.friction();
  const WhereToLook where =
      where_to_look(bed, least, std::exchange(dried_, cohesion.dried) != cohesion.dried);
  const std::vector<TileToLookAt>& tiles = where.tiles;
  if (tiles.empty()) return {};
  std::vector<std::vector<Failure>> found(tiles.size());
  std::vector<std::int64_t> toes(tiles.size(), 0);
  // One window for all rays, if it is no larger than theirs together.
  CellRange all;
  double sum = 0.0;
  for (const TileToLookAt& one : tiles) {
    all = around(all, one.rays);
    sum += area(one.rays);
  }
  std::optional<Window> shared;
  if (area(all) <= sum) shared.emplace(bed, level_, cohesion, where.highest_floor, all);
  parallel_for(tiles.size(), [&](std::size_t i) {
    const double top = tiles[i].top;
    std::optional<Window> own;
    if (!shared) own.emplace(bed, level_, cohesion, where.highest_floor, tiles[i].rays);
    const Window& sand = shared ? *shared : *own;
    const auto look_at_cell = [&](int row, int col, double funnel) {
      const double toe = sand.height(row, col), above = std::min(top - toe, funnel - toe + spare());
      if (above <= safe || !is_toe(sand, row, col, mu) || bed.is_wall(row, col)) return;
      ++toes[i];
      const Uphill uphill = uphill_of(sand, row, col, mu);
      const double longest = longest_run(toe, above, top, where.highest_floor, least);
      const Wedge wedge = worst_wedge(sand, row, col, uphill, factor_, longest, 1.0);
      if (wedge.need > 1.0) found[i].push_back({row, col, toe, uphill, wedge});
    };
    for (std::uint64_t left = tiles[i].blocks; left; left &= left - 1) {
      const CellRange cells = cells_of_block(bed.tile_cells(tiles[i].tile), std::countr_zero(left));
      const double funnel =
          where.funnels->level(cells.row_begin / BlockRanges::block, cells.col_begin / BlockRanges::block);
      for (int row = cells.row_begin; row < cells.row_end; ++row)
        for (int col = cells.col_begin; col < cells.col_end; ++col) look_at_cell(row, col, funnel);
    }
  });
  Look look;
  look.tiles = std::ssize(tiles);
  std::vector<Failure> failures;
  for (std::size_t i = 0; i < tiles.size(); ++i) {
    look.toes += toes[i];
    failures.insert(failures.end(), found[i].begin(), found[i].end());
  }
  look.failed = std::ssize(failures);
  if (failures.empty()) return look;
  const HeightField before = level_;
  lower(bed, before, failures);
  for (const int slot : level_.disturbed_tiles()) {
    const int tile = level_.tile_of(slot), bed_slot = bed.allocate(tile);
    const CellRange cells = level_.tile_cells(tile);
    for (int row = 0; row < cells.rows(); ++row) {
      const std::uint64_t lowered = level_.disturbed_cells(slot)[row];
      if (lowered) bed.mark_disturbed(bed_slot, row, lowered);
      for (std::uint64_t left = lowered; left; left &= left - 1) {
        const int r = cells.row_begin + row, c = cells.col_begin + std::countr_zero(left);
        look.volume += (before(r, c) - level_(r, c)) * level_.cell_area();
      }
    }
  }
  level_.clear_disturbed();
  return look;
}

/// Lowers the level to the chords of the wedges, and opens it.
void StandingCuts::lower(const HeightField& bed, const HeightField& before,
                         const std::vector<Failure>& failures) {
  for (const Failure& one : failures)
    visit_wedge(one.row, one.col, one.toe, one.uphill, one.wedge, bed.cell_size(), bed.rows(), bed.cols(),
                [&](int row, int col, double chord) {
                  const double level = std::max(chord, bed.floor(row, col));
                  if (level < level_(row, col)) level_.set(row, col, level);
                });
  // The cells near lowered ones lie in tiles with lowered ones, or beside those.
  std::vector<double> lowered(bed.tile_count(), 0.0);
  for (const int slot : level_.disturbed_tiles()) lowered[level_.tile_of(slot)] = 1.0;
  const std::vector<double> near = greatest_near(bed, lowered, 1);
  constexpr int rim = 2 * standing::opening;
  std::vector<std::pair<CellRange, HeightGrid>> opened;
  for (int tile = 0; tile < bed.tile_count(); ++tile) {
    if (near[tile] == 0.0) continue;
    const CellRange cells = bed.tile_cells(tile);
    const CellRange wide = common(grown(cells, rim), {0, bed.rows(), 0, bed.cols()});
    HeightGrid then(wide.rows(), wide.cols()), now(wide.rows(), wide.cols());
    before.read_cells(wide, then.data(), wide.cols());
    level_.read_cells(wide, now.data(), wide.cols());
    open_level(then, now);
    opened.emplace_back(cells, now.block(cells.row_begin - wide.row_begin, cells.col_begin - wide.col_begin,
                                         cells.rows(), cells.cols()));
  }
  for (const auto& [cells, levels] : opened)
    for (int row = 0; row < cells.rows(); ++row)
      for (int col = 0; col < cells.cols(); ++col) {
        const int r = cells.row_begin + row, c = cells.col_begin + col;
        const double level = std::max(levels(row, col), bed.floor(r, c));
        if (level < level_(r, c)) level_.set(r, c, level);
      }
}

void StandingCuts::visit_state(StateVisitor& state) {
  level_.visit_state(state);
  state.row("standing.seen", seen_);
  state.value("standing.dried", dried_);
  state.value("standing.dry_since", dry_since_);
  state.list("standing.dry_tiles", dry_tiles_);
  if (state.restores())
    for (BlockRanges& range : ranges_) range.revision = never;
}

}  // namespace sandstroke
