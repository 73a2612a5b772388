#include "sand/block_ranges.h"

#include <algorithm>
#include <optional>

namespace sandstroke {

void BlockRanges::know(const HeightField& bed, int tile) {
  if (revision == bed.tile_revision(tile)) return;
  revision = bed.tile_revision(tile);
  const CellRange cells = bed.tile_cells(tile);
  blocks.clear();
  whole = {};
  if (bed.slot_of(tile) < 0)
    if (const std::optional<double> level = bed.untouched().level(bed, cells)) {
      whole = {*level, *level};
      return;
    }
  std::array<double, BedGeometry::tile_area> heights;
  bed.read_tile(tile, heights.data());
  blocks.resize(static_cast<std::size_t>(side) * side);
  for (int row = 0; row < cells.rows(); ++row)
    for (int col = 0; col < cells.cols(); ++col) {
      Range& range = blocks[row / block * side + col / block];
      const double height = heights[row * BedGeometry::tile_side + col];
      range.low = std::min(range.low, height);
      range.high = std::max(range.high, height);
    }
  for (const Range& range : blocks)
    whole = {std::min(whole.low, range.low), std::max(whole.high, range.high)};
}

Funnels::Funnels(const HeightField& bed, const std::vector<BlockRanges>& ranges, const CellRange& tiles,
                 double slope)
    : row_begin_(tiles.row_begin * BlockRanges::side),
      col_begin_(tiles.col_begin * BlockRanges::side),
      rows_(tiles.rows() * BlockRanges::side),
      cols_(tiles.cols() * BlockRanges::side) {
  constexpr int side = BlockRanges::side;
  const auto high = [&](int row, int col) {
    const int tile = bed.tile_index(tiles.row_begin + row / side, tiles.col_begin + col / side);
    return ranges[tile].of(row % side * side + col % side).high;
  };
  // Cells of two blocks that are k apart, in rows or columns, are at least k - 1 blocks apart.
  std::vector<double> along(static_cast<std::size_t>(rows_) * cols_);
  for (int row = 0; row < rows_; ++row)
    for (int col = 0; col < cols_; ++col)
      along[static_cast<std::size_t>(row) * cols_ + col] = std::max(
          {high(row, std::max(col - 1, 0)), high(row, col), high(row, std::min(col + 1, cols_ - 1))});
  levels_.resize(along.size());
  for (int row = 0; row < rows_; ++row)
    for (int col = 0; col < cols_; ++col) {
      const auto at = [&](int r) { return along[static_cast<std::size_t>(r) * cols_ + col]; };
      levels_[static_cast<std::size_t>(row) * cols_ + col] =
          std::max({at(std::max(row - 1, 0)), at(row), at(std::min(row + 1, rows_ - 1))});
    }
  const double fall = slope * bed.cell_size() * BlockRanges::block;
  const auto spread = [&](int row, int col, int step) {
    double& level = levels_[static_cast<std::size_t>(row) * cols_ + col];
    const auto take = [&](int r, int c) {
      if (r >= 0 && r < rows_ && c >= 0 && c < cols_)
        level = std::max(level, levels_[static_cast<std::size_t>(r) * cols_ + c] - fall);
    };
    for (int c = -1; c <= 1; ++c) take(row + step, col + c);
    take(row, col + step);
  };
  for (int row = 0; row < rows_; ++row)
    for (int col = 0; col < cols_; ++col) spread(row, col, -1);
  for (int row = rows_ - 1; row >= 0; --row)
    for (int col = cols_ - 1; col >= 0; --col) spread(row, col, 1);
}

Funnels::Below Funnels::below(const HeightField& bed, int tile, const BlockRanges& ranges,
                              double least) const {
  constexpr int side = BlockRanges::side;
  const int row = tile / bed.tile_cols() * side, col = tile % bed.tile_cols() * side;
  Below found;
  for (int i = 0; i < side; ++i)
    for (int j = 0; j < side; ++j) {
      const double depth = level(row + i, col + j) - ranges.of(i * side + j).low;
      if (!(depth > least)) continue;
      found.blocks |= std::uint64_t{1} << (i * side + j);
      found.most = std::max(found.most, depth);
    }
  return found;
}

}  // namespace sandstroke
