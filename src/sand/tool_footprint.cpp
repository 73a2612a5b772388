#include "sand/tool_footprint.h"

#include <cmath>
#include <limits>

#include "sand/footprint_kernels.h"

namespace sandstroke {

ToolFootprint::ToolFootprint(const ToolSettings& settings)
    : shape_{settings.profile, settings.radius, settings.radius * settings.radius / filter::u0,
             settings.radius / (2.0 * filter::u0), settings.radius * std::sqrt(filter::u1 / filter::u0)},
      level_(std::numeric_limits<double>::quiet_NaN()) {}

void ToolFootprint::place(const HeightField& bed, double x, double y) {
  cells_ = {};
  level_ = std::numeric_limits<double>::quiet_NaN();
  cell_size_ = bed.cell_size();
  tool_row_ = bed.row_at(y), tool_col_ = bed.col_at(x);
  const double extent = shape_.reach / cell_size_ + 1.0;  // cells; beyond it the level weight is 0
  if (!(tool_row_ + extent >= 0.0 && tool_row_ - extent <= bed.rows() - 1.0)) return;
  if (!(tool_col_ + extent >= 0.0 && tool_col_ - extent <= bed.cols() - 1.0)) return;
  cells_.row_begin = std::max(0, static_cast<int>(std::ceil(tool_row_ - extent)));
  cells_.row_end = std::min(bed.rows() - 1, static_cast<int>(std::floor(tool_row_ + extent))) + 1;
  cells_.col_begin = std::max(0, static_cast<int>(std::ceil(tool_col_ - extent)));
  cells_.col_end = std::min(bed.cols() - 1, static_cast<int>(std::floor(tool_col_ + extent))) + 1;
  if (cells_.empty()) return cells_ = {}, void();
  stride_ = (cells_.cols() + 7) / 8 * 8;
  make_room();
  read_heights(bed);
  level_ = shape_footprint(shape_, *this);
}

void ToolFootprint::make_room() {
  const std::size_t needed = at(cells_.rows());
  if (needed <= room_) return;
  room_ = needed + needed / 4;  // the window's size changes by a row or column as the tool moves
  for (auto* memory : {&heights_, &underside_, &rampart_, &weights_}) {
    *memory = hwy::AllocateAligned<double>(room_);
    std::fill_n(memory->get(), room_, 0.0);
  }
  flags_ = hwy::AllocateAligned<unsigned char>(room_ / 8 + 1);
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

}  // namespace

void ToolFootprint::read_heights(const HeightField& bed) {
  constexpr int side = BedGeometry::tile_side;
  for_tile_columns(cells_, [&](int tile_col, int first, int end) {
    for (int row = cells_.row_begin; row < cells_.row_end; ++row) {
      double* out = heights(row - cells_.row_begin) + (first - cells_.col_begin);
      const int slot = bed.slot_of(bed.tile_index(row / side, tile_col));
      if (slot < 0) {
        bed.untouched().fill(bed, {row, row + 1, first, end}, out);
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
      const unsigned char* flagged = flags(row - cells_.row_begin);
      std::uint64_t changed = 0;
      for (int i = first - cells_.col_begin; i < end - cells_.col_begin; ++i)
        changed |= static_cast<std::uint64_t>(flagged[i / 8] >> (i % 8) & 1)
                   << ((cells_.col_begin + i) % side);
      if (!changed) continue;
      const int slot = bed.touch(bed.tile_index(row / side, tile_col));
      std::copy_n(in, end - first, bed.tile_heights(slot) + (row % side) * side + first % side);
      bed.mark_disturbed(slot, row % side, changed);
    }
  });
}

}  // namespace sandstroke
