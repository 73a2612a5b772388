#include "sand/tool_footprint.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <tuple>

#include "sand/ground.h"

namespace sandstroke {
namespace {

/// The range [begin, end) of the cells whose centres lie between two positions, in a line of `count` cells.
/// Positions count in cells from the line's centre.
std::pair<int, int> cells_between(double low, double high, int count) {
  // The centre is at cell (count - 1) / 2, maybe a half. Adding the half first rounds alike for any even
  // count.
  const int centre = (count - 1) / 2;
  const double half = count % 2 == 0 ? 0.5 : 0.0;
  return {std::max(0, centre + static_cast<int>(std::ceil(low + half))),
          std::min(count - 1, centre + static_cast<int>(std::floor(high + half))) + 1};
}

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

void ToolFootprint::set_axis(const BedGeometry& bed, double x, double y) {
  close();
  bed_ = bed;
  axis_x_ = x / cell_size();
  axis_y_ = y / cell_size();
}

bool ToolFootprint::open(const HeightField& bed, const Extent& extent) {
  constexpr double beyond_any_bed = 1e9;  // cells
  if (!(std::abs(axis_x_) < beyond_any_bed && std::abs(axis_y_) < beyond_any_bed)) return false;
  std::tie(cells_.row_begin, cells_.row_end) =
      cells_between(axis_y_ + extent.down, axis_y_ + extent.up, bed.rows());
  std::tie(cells_.col_begin, cells_.col_end) =
      cells_between(axis_x_ + extent.left, axis_x_ + extent.right, bed.cols());
  if (cells_.empty()) {
    close();
    return false;
  }
  first_x_ = bed_.cols_from_centre(cells_.col_begin);
  first_y_ = bed_.rows_from_centre(cells_.row_begin);
  stride_ = (cells_.cols() + cells_per_group - 1) / cells_per_group * cells_per_group;
  make_room();
  read_heights(bed);
  read_floors(bed);
  return true;
}

void ToolFootprint::make_room() {
  const std::size_t needed = at(cells_.rows());
  if (needed <= room_ && weights_.size() == room_) return;
  // Takes room for one row and one group more: the window may grow so as the tool moves, and a servo loop
  // must not allocate memory.
  if (needed > room_) room_ = static_cast<std::size_t>(cells_.rows() + 1) * (stride_ + cells_per_group);
  for (AlignedVector<double>* memory : std::initializer_list<AlignedVector<double>*>{
           &heights_, &underside_, &takes_, &excess_, &ring_weight_, &weights_})
    memory->assign(room_, 0.0);
  flags_.resize(room_ / cells_per_group + 1);
}

void ToolFootprint::read_heights(const HeightField& bed) { bed.read_cells(cells_, heights_.data(), stride_); }

void ToolFootprint::read_floors(const HeightField& bed) {
  highest_floor_ = -std::numeric_limits<double>::infinity();
  if (!bed.ground() || !bed.ground()->has_floor()) return;
  floors_.resize(room_, highest_floor_);
  bed.ground()->floor.read_cells(cells_, floors_.data(), stride_);
  for (int row = 0; row < cells_.rows(); ++row)
    highest_floor_ = std::max(highest_floor_, *std::max_element(floors(row), floors(row) + cells_.cols()));
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

void ToolFootprint::make_walls(HeightField& bed) {
  constexpr int side = BedGeometry::tile_side;
  bowl_.clear();
  for (int row = 0; row < cells_.rows(); ++row) {
    std::fill_n(flags(row), stride_ / cells_per_group, static_cast<unsigned char>(0));
    for (int col = 0; col < cells_.cols(); ++col)
      if (std::isfinite(underside(row)[col]))
        flags(row)[col / cells_per_group] |= static_cast<unsigned char>(1u << col % cells_per_group);
  }
  for_tile_columns(cells_, [&](int tile_col, int first, int end) {
    for (int row = cells_.row_begin; row < cells_.row_end; ++row) {
      const std::uint64_t bowl = flags_in_tile(flags(row - cells_.row_begin), cells_, tile_col, first, end);
      if (bowl) bowl_.push_back({bed.allocate(bed.tile_index(row / side, tile_col)), row % side, bowl});
    }
  });
  bed.set_tool_walls(bowl_);
}

}  // namespace sandstroke
