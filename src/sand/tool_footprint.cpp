#include "sand/tool_footprint.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "sand/footprint_kernels.h"

namespace sandstroke {
namespace {

/// [begin, end) of `count` cells in a line whose centres lie between two places, in cells from its centre.
std::pair<int, int> cells_between(double low, double high, int count) {
  // That centre is cell (count - 1) / 2, maybe a half: adding that first rounds alike for any even count.
  const int centre = (count - 1) / 2;
  const double half = count % 2 == 0 ? 0.5 : 0.0;
  return {std::max(0, centre + static_cast<int>(std::ceil(low + half))),
          std::min(count - 1, centre + static_cast<int>(std::floor(high + half))) + 1};
}

}  // namespace

ToolFootprint::ToolFootprint(const ToolSettings& settings)
    : shape_{settings.profile, settings.radius, settings.radius * settings.radius / filter::u0,
             settings.radius / (2.0 * filter::u0), settings.radius * std::sqrt(filter::u1 / filter::u0)},
      level_(std::numeric_limits<double>::quiet_NaN()) {}

void ToolFootprint::place(const HeightField& bed, double x, double y) {
  cells_ = {};
  level_ = std::numeric_limits<double>::quiet_NaN();
  bed_ = bed;
  axis_x_ = x / cell_size(), axis_y_ = y / cell_size();
  const double extent = shape_.reach / cell_size() + 1.0;  // cells; beyond it the level weight is 0
  if (!(std::abs(axis_y_) <= bed.rows_from_centre(bed.rows() - 1) + extent)) return;
  if (!(std::abs(axis_x_) <= bed.cols_from_centre(bed.cols() - 1) + extent)) return;
  std::tie(cells_.row_begin, cells_.row_end) = cells_between(axis_y_ - extent, axis_y_ + extent, bed.rows());
  std::tie(cells_.col_begin, cells_.col_end) = cells_between(axis_x_ - extent, axis_x_ + extent, bed.cols());
  if (cells_.empty()) {
    cells_ = {};
    return;
  }
  first_x_ = bed.cols_from_centre(cells_.col_begin), first_y_ = bed.rows_from_centre(cells_.row_begin);
  stride_ = (cells_.cols() + cells_per_group - 1) / cells_per_group * cells_per_group;
  make_room();
  read_heights(bed);
  level_ = level_of(shape_, *this);
}

void ToolFootprint::make_room() {
  const std::size_t needed = at(cells_.rows());
  if (needed <= room_) return;
  // As the tool moves, the window gains a row or a column, and so perhaps a group of the stride: not in a
  // servo loop.
  room_ = static_cast<std::size_t>(cells_.rows() + 1) * (stride_ + cells_per_group);
  for (auto* memory : {&heights_, &underside_, &takes_, &rampart_, &weights_, &excess_}) {
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

/// `flags`, a group to a byte from column `first` of the bed on, as those of their tile column.
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
  bowl_.clear();
  carve(shape_, *this, std::numeric_limits<double>::infinity());
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
