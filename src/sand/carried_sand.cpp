#include "sand/carried_sand.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/compensated_sum.h"
#include "rules/talus.h"
#include "sand/cells_around.h"
#include "sand/ground.h"

namespace sandstroke {

using Eigen::Vector2d;
using Eigen::Vector3d;

CarriedSand::CarriedSand(const RelaxationSettings& relaxation, const UpperSide& upper)
    : relaxation_(relaxation),
      thickness_(HeightGrid::Zero(upper.grid().rows(), upper.grid().cols())),
      columns_(thickness_),
      from_columns_(thickness_),
      tray_(upper.grid().rows(), upper.grid().cols(), upper.grid().cell_size()),
      relaxer_(make_relaxer(relaxation, upper.grid().cell_size())) {}

void CarriedSand::lie_on(const UpperSide& upper) {
  if (lies_on_ == upper.revision()) return;
  if (!empty()) {
    change_columns();
    thickness_ = columns_;
    if (upper.is_tilted()) {
      thickness_.setZero();
      for (const UpperSide::Share& share : upper.shares())
        thickness_.data()[share.cell] += share.part * columns_.data()[share.column];
    }
  } else {
    thickness_.setZero();
    columns_.setZero();
  }
  from_columns_ = thickness_;
  go_on(upper);
}

LoadSurface CarriedSand::surface(const UpperSide& upper) const {
  const BedGeometry& grid = upper.grid();
  const auto is_seen = [&](int row, int col) { return thickness_(row, col) > 0.02 * grid.cell_size(); };
  HeightGrid height =
      HeightGrid::Constant(grid.rows(), grid.cols(), std::numeric_limits<double>::quiet_NaN());
  for (int row = 0; row < grid.rows(); ++row)
    for (int col = 0; col < grid.cols(); ++col) {
      if (!is_seen(row, col)) continue;
      const double here = height(row, col) = upper.top()(row, col) + thickness_(row, col);
      // Its edge lies on the tool beside it, but not on a wall there.
      for (int r = std::max(row - 1, 0); r <= std::min(row + 1, grid.rows() - 1); ++r)
        for (int c = std::max(col - 1, 0); c <= std::min(col + 1, grid.cols() - 1); ++c)
          if (upper.covers(r, c) && !is_seen(r, c) &&
              std::abs(upper.top()(r, c) - here) < 2.0 * grid.cell_size())
            height(r, c) = upper.top()(r, c);
    }
  return {std::move(height), grid.cell_size(), upper.in_bed(Vector2d::UnitX())};
}

void CarriedSand::take(const UpperSide& upper, const std::vector<LiftedSand>& lifted) {
  if (lifted.empty()) return;
  for (const LiftedSand& one : lifted) {
    const Vector2d place = upper.in_grid(one.from_tip);
    const UpperSide::Cell cell = upper.cell_at(place);
    const UpperSide::Parts parts = upper.parts_at(place, upper.top()(cell.row, cell.col));
    for (int i = 0; i < parts.count; ++i) {
      const auto& [to, part] = parts.of[static_cast<std::size_t>(i)];
      thickness_.data()[to] += one.height * part;
    }
  }
  know_sums(upper);
}

/// A cell that lost sand took the same fraction from each column over it. What a cell gained goes to the
/// columns over it by their parts.
void CarriedSand::change_columns() {
  if (shares_.empty()) {
    columns_ = thickness_;
    return;
  }
  if ((thickness_ == from_columns_).all()) return;
  const auto size = static_cast<std::size_t>(thickness_.size());
  std::vector<double> parts(size, 0.0), lost(size, 0.0), gained(size, 0.0);
  for (const UpperSide::Share& share : shares_) parts[share.cell] += share.part;
  for (std::size_t cell = 0; cell < size; ++cell) {
    const double before = from_columns_.data()[cell], difference = thickness_.data()[cell] - before;
    if (difference < 0.0) lost[cell] = std::min(1.0, -difference / before);
    if (difference > 0.0) gained[parts[cell] > 0.0 ? cell : nearest_of(parts, cell)] += difference;
  }
  HeightGrid changed = columns_;
  for (const UpperSide::Share& share : shares_) {
    double& column = changed.data()[share.column];
    column -= share.part * lost[share.cell] * columns_.data()[share.column];
    if (gained[share.cell] > 0.0) column += gained[share.cell] * share.part / parts[share.cell];
  }
  columns_ = changed.max(0.0);
}

/// The cell with columns over it that is nearest to one without.
std::size_t CarriedSand::nearest_of(const std::vector<double>& parts, std::size_t cell) const {
  const auto cols = static_cast<std::size_t>(thickness_.cols());
  const auto way = [&](std::size_t from, std::size_t to) {
    const double down = static_cast<double>(to / cols) - static_cast<double>(from / cols),
                 along = static_cast<double>(to % cols) - static_cast<double>(from % cols);
    return down * down + along * along;
  };
  std::size_t nearest = cell;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t other = 0; other < parts.size(); ++other) {
    if (!(parts[other] > 0.0) || way(cell, other) >= least) continue;
    least = way(cell, other);
    nearest = other;
  }
  return nearest;
}

void CarriedSand::know_sums(const UpperSide& upper) {
  const BedGeometry& grid = upper.grid();
  CompensatedSum volume;
  moment_.setZero();
  for (int row = 0; row < grid.rows(); ++row)
    for (int col = 0; col < grid.cols(); ++col) {
      const double thickness = thickness_(row, col);
      if (thickness == 0.0) continue;
      volume.add(thickness);
      moment_ +=
          thickness * Vector3d(grid.x_of(col), grid.y_of(row), upper.top()(row, col) + 0.5 * thickness);
    }
  volume_ = volume.value() * grid.cell_area();
  moment_ = upper.untilted(grid.cell_area() * moment_);
  know_shares(upper);
}

void CarriedSand::know_shares(const UpperSide& upper) {
  if (shares_.empty() && !empty() && upper.is_tilted()) shares_ = upper.shares();
}

void CarriedSand::lay_out(const UpperSide& upper) {
  const BedGeometry& grid = upper.grid();
  tray_ = HeightField(grid.rows(), grid.cols(), grid.cell_size());
  relaxer_ = Copied<Relaxer>(make_relaxer(relaxation_, grid.cell_size()));
  beside_.clear();
  constexpr int reach = UpperSide::margin;
  double lowest = std::numeric_limits<double>::infinity();
  for (int row = 0; row < grid.rows(); ++row)
    for (int col = 0; col < grid.cols(); ++col) {
      if (upper.covers(row, col)) {
        lowest = std::min(lowest, upper.top()(row, col));
        continue;
      }
      double rim = UpperSide::nowhere;
      for (int r = std::max(row - reach, 0); r <= std::min(row + reach, grid.rows() - 1); ++r)
        for (int c = std::max(col - reach, 0); c <= std::min(col + reach, grid.cols() - 1); ++c)
          rim = std::max(rim, upper.top()(r, c));
      if (rim == UpperSide::nowhere) continue;
      Beside one{};
      one.row = row;
      one.col = col;
      one.rim = rim;
      beside_.push_back(one);
    }
  // All that the tool may carry has room there.
  deep_ = lowest - grid.rows() * grid.cell_size();
  free_ = Cells::Constant(grid.rows(), grid.cols(), true);
  is_laid_out_ = true;
}

void CarriedSand::look_beside(const UpperSide& upper, const HeightField& bed, const Vector3d& tip) {
  const BedGeometry& grid = upper.grid();
  const double below_rim = (UpperSide::margin + 1) * talus_slope(relaxation_.talus_angle) * grid.cell_size();
  bool is_near = false;
  for (Beside& one : beside_) {
    const Vector2d place = tip.head<2>() + upper.in_bed({grid.x_of(one.col), grid.y_of(one.row)});
    const double col = bed.col_at(place.x()), row = bed.row_at(place.y());
    one.count = 0;
    double whole = 0.0, sum = 0.0;
    if (row > -1.0 && row < bed.rows() && col > -1.0 && col < bed.cols())
      visit_cells_around(row, col, [&](int r, int c, double part) {
        if (r < 0 || r >= bed.rows() || c < 0 || c >= bed.cols() || bed.is_wall(r, c)) return;
        one.bed[one.count++] = {r, c, part};
        whole += part;
        sum += part * bed(r, c);
      });
    for (int i = 0; i < one.count; ++i) one.bed[i].part /= whole;
    one.start = one.count > 0 ? std::max(sum / whole - tip.z(), deep_) : deep_;
    is_near = is_near || one.start > one.rim - below_rim;
  }
  // Sand that lies so deep all around holds nothing on the tool, and none of it runs there: it need not be
  // known how deep, so that a tool in the air keeps its bits.
  if (!is_near)
    for (Beside& one : beside_) one.start = deep_;
}

bool CarriedSand::sand_may_run_on() const {
  return std::any_of(beside_.begin(), beside_.end(),
                     [](const Beside& one) { return one.count > 0 && one.start > one.rim; });
}

void CarriedSand::set_walls(const UpperSide& upper) {
  const BedGeometry& grid = upper.grid();
  Cells is_free = Cells::Constant(grid.rows(), grid.cols(), false);
  for (int row = 0; row < grid.rows(); ++row)
    for (int col = 0; col < grid.cols(); ++col) is_free(row, col) = upper.covers(row, col);
  for (const Beside& one : beside_) is_free(one.row, one.col) = one.count > 0;
  if ((is_free == free_).all()) return;
  free_ = is_free;
  constexpr int side = BedGeometry::tile_side;
  std::vector<RowCells> walls;
  for (int tile = 0; tile < grid.tile_count(); ++tile) {
    const CellRange cells = grid.tile_cells(tile);
    for (int row = cells.row_begin; row < cells.row_end; ++row) {
      std::uint64_t flags = 0;
      for (int col = cells.col_begin; col < cells.col_end; ++col)
        if (!free_(row, col)) flags |= std::uint64_t{1} << (col % side);
      if (flags) walls.push_back({tray_.allocate(tile), row % side, flags});
    }
  }
  tray_.set_tool_walls(walls);
}

double CarriedSand::take_from_bed(HeightField& bed, const Beside& one, double height) const {
  double weights[4], whole = 0.0;
  for (int i = 0; i < one.count; ++i) {
    const double above = bed(one.bed[i].row, one.bed[i].col) - bed.floor(one.bed[i].row, one.bed[i].col);
    weights[i] = one.bed[i].part * std::min(above, 1.0);
    whole += weights[i];
  }
  double taken = 0.0;
  for (int i = 0; i < one.count; ++i) {
    const auto [row, col, part] = one.bed[i];
    const double before = bed(row, col),
                 after = std::max(before - height * (weights[i] / whole), bed.floor(row, col));
    if (after == before) continue;
    bed.set(row, col, after);
    taken += before - after;
  }
  return taken;
}

CarriedSand::Outcome CarriedSand::relax(const UpperSide& upper, HeightField& bed, const Vector3d& tip) {
  Outcome outcome;
  if (!is_laid_out_) lay_out(upper);
  look_beside(upper, bed, tip);
  if (empty() && !sand_may_run_on()) return outcome;
  const BedGeometry& grid = upper.grid();
  auto ground = std::make_shared<Ground>(grid, talus_slope(relaxation_.talus_angle));
  const auto put = [&](int row, int col, double height) {
    if (tray_(row, col) != height) tray_.set(row, col, height);
  };
  for (int row = 0; row < grid.rows(); ++row)
    for (int col = 0; col < grid.cols(); ++col) {
      if (!upper.covers(row, col)) continue;
      ground->floor.set(row, col, upper.top()(row, col));
      put(row, col, upper.top()(row, col) + thickness_(row, col));
    }
  for (const Beside& one : beside_) {
    double floor = UpperSide::nowhere;
    for (int i = 0; i < one.count; ++i) floor = std::max(floor, bed.floor(one.bed[i].row, one.bed[i].col));
    ground->floor.set(one.row, one.col, std::min(floor - tip.z(), one.start));
    put(one.row, one.col, one.start);
  }
  set_walls(upper);
  std::shared_ptr<const Ground> under = std::move(ground);
  tray_.exchange_ground(under);
  relaxer_->relax(tray_);

  double net = 0.0;
  for (const Beside& one : beside_) {
    const double risen = tray_(one.row, one.col) - one.start;
    if (risen == 0.0 || one.count == 0) continue;
    if (risen < 0.0) {
      net -= take_from_bed(bed, one, -risen);
      continue;
    }
    for (int i = 0; i < one.count; ++i)
      outcome.spills.push_back(
          {one.bed[i].row, one.bed[i].col, risen * grid.cell_area() * one.bed[i].part, tip.z() + one.rim});
    net += risen;
  }
  (net > 0.0 ? outcome.spilled : outcome.ran_on) = std::abs(net) * grid.cell_area();
  bool changed = false;
  for (int row = 0; row < grid.rows(); ++row)
    for (int col = 0; col < grid.cols(); ++col) {
      if (!upper.covers(row, col)) continue;
      const double risen = tray_(row, col) - (upper.top()(row, col) + thickness_(row, col));
      if (risen == 0.0) continue;
      thickness_(row, col) = std::max(thickness_(row, col) + risen, 0.0);
      changed = true;
    }
  if (changed) know_sums(upper);
  return outcome;
}

void CarriedSand::visit_state(StateVisitor& state) {
  const auto visit = [&](const char* name, HeightGrid& grid) {
    std::vector<double> heights(grid.data(), grid.data() + grid.size());
    state.row(name, heights);
    if (state.restores()) std::copy(heights.begin(), heights.end(), grid.data());
  };
  visit("carried.thickness", thickness_);
  visit("carried.columns", columns_);
  visit("carried.from_columns", from_columns_);
  state.value("carried.volume", volume_);
  state.value("carried.moment", moment_);
}

void CarriedSand::go_on(const UpperSide& upper) {
  shares_.clear();
  know_shares(upper);
  lies_on_ = upper.revision();
  is_laid_out_ = false;
}

}  // namespace sandstroke
