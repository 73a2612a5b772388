#include "sand/tool_footprint.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "sand/footprint_kernels.h"
#include "tool/tool_surface.h"

namespace sandstroke {
namespace {

/// The range [begin, end) of the cells whose centres lie between two places, in a line of `count` cells.
/// Places count in cells from the line's centre.
std::pair<int, int> cells_between(double low, double high, int count) {
  // The centre is at cell (count - 1) / 2, maybe a half. Adding the half first rounds alike for any even
  // count.
  const int centre = (count - 1) / 2;
  const double half = count % 2 == 0 ? 0.5 : 0.0;
  return {std::max(0, centre + static_cast<int>(std::ceil(low + half))),
          std::min(count - 1, centre + static_cast<int>(std::floor(high + half))) + 1};
}

}  // namespace

ToolFootprint::ToolFootprint(const ToolSettings& settings)
    : shape_{settings.profile, settings.radius, settings.radius * settings.radius / filter::u0,
             settings.radius / (2.0 * filter::u0), filter::reach(settings.radius)},
      level_(std::numeric_limits<double>::quiet_NaN()) {
  if (settings.shape == ToolShape::sphere) return;
  surface_ = tool_surface(settings);
  rotation_ = own_rotation(settings);
  for (const Eigen::Vector3d& vertex : surface_.vertices) farthest_ = std::max(farthest_, vertex.norm());
  shape_.radius = shape_.reach = horizontal_reach(turned(surface_, rotation_));
}

bool ToolFootprint::would_turn(const Eigen::Matrix3d& rotation) const {
  if (is_sphere() || rotation == rotation_) return false;
  return !envelope_ ||
         (rotation - rotation_).norm() * farthest_ >= envelope_->cell_size() / (8.0 * envelope_->phases());
}

void ToolFootprint::turn(const Eigen::Matrix3d& rotation) {
  if (!would_turn(rotation)) return;
  rotation_ = rotation;
  envelope_.reset();
  cells_ = {};
}

void ToolFootprint::place(const HeightField& bed, double x, double y) {
  cells_ = {};
  level_ = std::numeric_limits<double>::quiet_NaN();
  bed_ = bed;
  axis_x_ = x / cell_size(), axis_y_ = y / cell_size();
  if (!is_sphere()) return place_envelope(bed);
  const double extent = shape_.reach / cell_size() + 1.0;  // cells; beyond it the level weight is 0
  if (!(std::abs(axis_y_) <= bed.rows_from_centre(bed.rows() - 1) + extent)) return;
  if (!(std::abs(axis_x_) <= bed.cols_from_centre(bed.cols() - 1) + extent)) return;
  std::tie(cells_.row_begin, cells_.row_end) = cells_between(axis_y_ - extent, axis_y_ + extent, bed.rows());
  std::tie(cells_.col_begin, cells_.col_end) = cells_between(axis_x_ - extent, axis_x_ + extent, bed.cols());
  if (cells_.empty()) {
    cells_ = {};
    return;
  }
  take_window();
  read_heights(bed);
  level_ = level_of(shape_, *this);
}

double ToolFootprint::highest_at_rim() const {
  const double rim = shape_.radius / cell_size(), beyond = rim + 1.0;  // cells
  double highest = -std::numeric_limits<double>::infinity();
  for (int row = 0; row < cells_.rows(); ++row) {
    const double y = first_y_ + row - axis_y_;
    const ColumnRange sand = sand_cols(row);
    for (int col = sand.begin; col < sand.end; ++col) {
      const double x = first_x_ + col - axis_x_, rho2 = x * x + y * y;
      if (rho2 > rim * rim && rho2 <= beyond * beyond) highest = std::max(highest, heights(row)[col]);
    }
  }
  return highest;
}

void ToolFootprint::take_window() {
  first_x_ = bed_.cols_from_centre(cells_.col_begin), first_y_ = bed_.rows_from_centre(cells_.row_begin);
  stride_ = (cells_.cols() + cells_per_group - 1) / cells_per_group * cells_per_group;
  make_room();
}

void ToolFootprint::place_envelope(const HeightField& bed) {
  if (!envelope_ || envelope_->cell_size() != bed.cell_size()) {
    envelope_.emplace(turned(surface_, rotation_), bed.cell_size());
    shape_.radius = envelope_->inradius(), shape_.reach = envelope_->reach();
  }
  constexpr double beyond_any_bed = 1e6;  // cells
  if (!(std::abs(axis_x_) < beyond_any_bed && std::abs(axis_y_) < beyond_any_bed)) return;
  const int last_row = envelope_->first_row() + envelope_->rows() - 2,
            last_col = envelope_->first_col() + envelope_->cols() - 2;
  std::tie(cells_.row_begin, cells_.row_end) =
      cells_between(axis_y_ + envelope_->first_row(), axis_y_ + last_row, bed.rows());
  std::tie(cells_.col_begin, cells_.col_end) =
      cells_between(axis_x_ + envelope_->first_col(), axis_x_ + last_col, bed.cols());
  if (cells_.empty()) {
    cells_ = {};
    return;
  }
  take_window();
  read_heights(bed);
  find_first_sample();
  level_ = fit_sand_plane(bed, axis_x_ * cell_size(), axis_y_ * cell_size(), envelope_->reach()).height;
}

void ToolFootprint::find_first_sample() {
  // For multiples of 2^-30 the distances to a sample and to the next one are both exact.
  const auto split = [&](double cells, int first, int& sample, double& rest) {
    const double place = std::round(envelope_->phases() * cells * 0x1p30) * 0x1p-30;
    const double whole = std::floor(place);
    rest = place - whole;
    sample = std::max(static_cast<int>(whole) - first * envelope_->phases(), 0);
  };
  split(first_x_ - axis_x_, envelope_->first_col(), sample_col_, sample_x_);
  split(first_y_ - axis_y_, envelope_->first_row(), sample_row_, sample_y_);
}

double ToolFootprint::covered_height(double tip_height, double touched) const {
  const double depth = level_ - (tip_height + lowest());
  return envelope_->covered_height(std::max(lowest() + (depth > 0.0 ? 2.0 * depth : 0.0), touched));
}

EnvelopePlace ToolFootprint::envelope_place() const {
  EnvelopePlace place;
  place.stride = envelope_->stride();
  const int phases = envelope_->phases();
  for (int corner = 0; corner < 4; ++corner) {
    const int right = corner % 2, up = corner / 2, row = sample_row_ + up, col = sample_col_ + right;
    const std::size_t at = envelope_->at(row / phases, col / phases, row % phases, col % phases);
    place.underside[corner] = envelope_->underside() + at;
    place.cover[corner] = envelope_->cover() + at;
    place.weight[corner] = (right ? sample_x_ : 1.0 - sample_x_) * (up ? sample_y_ : 1.0 - sample_y_);
  }
  return place;
}

double ToolFootprint::carve(double tip_height) {
  const CarvedUnder carved = carve_under(envelope_place(), *this, tip_height);
  touches_ = std::isfinite(carved.highest);
  covered_ = covered_height(tip_height, carved.highest);
  cover_up_to(*this, covered_);
  return carved.sum;
}

void ToolFootprint::meet(const HeightField& bed, double tip_height) {
  if (is_sphere())
    sandstroke::carve(shape_, *this, tip_height);
  else
    carve(tip_height);
  read_heights(bed);
}

void ToolFootprint::stand(double tip_height) {
  if (!cells_.empty()) covered_ = covered_height(tip_height, -std::numeric_limits<double>::infinity());
}

WayOutPlace ToolFootprint::way_out(double distance) {
  const int phases = envelope_->phases();
  const int row = sample_row_ + (sample_y_ >= 0.5), col = sample_col_ + (sample_x_ >= 0.5);
  const WayOut& way = envelope_->way_out(covered_, distance, row % phases, col % phases);
  const std::size_t at = envelope_->at(row / phases, col / phases, 0, 0);
  return {way.x.data() + at, way.y.data() + at, envelope_->stride()};
}

void ToolFootprint::make_room() {
  const std::size_t needed = at(cells_.rows());
  if (needed <= room_) return;
  // Takes room for one row and one group more: the window may grow so as the tool moves, and a servo loop
  // must not allocate memory.
  room_ = static_cast<std::size_t>(cells_.rows() + 1) * (stride_ + cells_per_group);
  for (auto* memory : {&heights_, &underside_, &takes_, &ring_weight_, &weights_, &excess_}) {
    *memory = hwy::AllocateAligned<double>(room_);
    std::fill_n(memory->get(), room_, 0.0);
  }
  flags_ = hwy::AllocateAligned<unsigned char>(room_ / cells_per_group + 1);
}

namespace {

/// Calls body(tile column, first column, end column) for the tiles that a range of columns lies in.
template <class Body>
void for_tile_columns(const CellRange& cells, const Body& body) {
  constexpr int side = BedGeometry::tile_side;
  for (int first = cells.col_begin; first < cells.col_end;) {
    const int end = std::min((first / side + 1) * side, cells.col_end);
    body(first / side, first, end);
    first = end;
  }
}

/// Converts `flags` (a byte per group, from the window's first column on) to flags of the columns of a tile.
std::uint64_t flags_in_tile(const unsigned char* flags, const CellRange& cells, int tile_col, int first,
                            int end) {
  std::uint64_t in_tile = 0;  // no flag lies beyond the window's last column
  for (int group = (first - cells.col_begin) / cells_per_group;
       group <= (end - 1 - cells.col_begin) / cells_per_group; ++group) {
    const int at = cells.col_begin + cells_per_group * group - tile_col * BedGeometry::tile_side;
    const std::uint64_t bits = flags[group];
    in_tile |= at < 0 ? bits >> -at : bits << at;
  }
  return in_tile;
}

}  // namespace

void ToolFootprint::read_heights(const HeightField& bed) {
  constexpr int side = BedGeometry::tile_side;
  for_tile_columns(cells_, [&](int tile_col, int first, int end) {
    for (int row = cells_.row_begin; row < cells_.row_end; ++row) {
      double* out = heights(row - cells_.row_begin) + (first - cells_.col_begin);
      const int slot = bed.slot_of(bed.tile_index(row / side, tile_col));
      if (slot < 0) {
        bed.untouched().fill(bed, {row, row + 1, first, end}, out, stride_);
      } else {
        std::copy_n(bed.tile_heights(slot) + (row % side) * side + first % side, end - first, out);
      }
    }
  });
}

void ToolFootprint::write_flagged(HeightField& bed) {
  constexpr int side = BedGeometry::tile_side;
  for_tile_columns(cells_, [&](int tile_col, int first, int end) {
    for (int row = cells_.row_begin; row < cells_.row_end; ++row) {
      const double* in = heights(row - cells_.row_begin) + (first - cells_.col_begin);
      const std::uint64_t changed =
          flags_in_tile(flags(row - cells_.row_begin), cells_, tile_col, first, end);
      if (!changed) continue;
      const int slot = bed.allocate(bed.tile_index(row / side, tile_col));
      std::copy_n(in, end - first, bed.tile_heights(slot) + (row % side) * side + first % side);
      bed.mark_disturbed(slot, row % side, changed);
    }
  });
}

void ToolFootprint::hold_bowl(HeightField& bed) {
  constexpr int side = BedGeometry::tile_side;
  constexpr double nowhere = std::numeric_limits<double>::infinity();
  bowl_.clear();
  if (is_sphere())
    sandstroke::carve(shape_, *this, nowhere);
  else if (!cells_.empty())
    carve_under(envelope_place(), *this, nowhere), cover_up_to(*this, covered_);
  for (int row = 0; row < cells_.rows(); ++row) {
    std::fill_n(flags(row), stride_ / cells_per_group, static_cast<unsigned char>(0));
    for (int col = 0; col < cells_.cols(); ++col)
      if (std::isfinite(underside(row)[col]))
        flags(row)[col / cells_per_group] |= static_cast<unsigned char>(1u << col % cells_per_group);
  }
  for_tile_columns(cells_, [&](int tile_col, int first, int end) {
    for (int row = cells_.row_begin; row < cells_.row_end; ++row) {
      const std::uint64_t held = flags_in_tile(flags(row - cells_.row_begin), cells_, tile_col, first, end);
      if (held) bowl_.push_back({bed.allocate(bed.tile_index(row / side, tile_col)), row % side, held});
    }
  });
  bed.hold(bowl_);
}

}  // namespace sandstroke
