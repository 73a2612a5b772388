#include "sand/height_field.h"

#include <algorithm>

#include "core/compensated_sum.h"

namespace sandstroke {

HeightField::HeightField(int rows, int cols, double cell_size)
    : rows_(rows),
      cols_(cols),
      cell_size_(cell_size),
      row_origin_(0.5 * (rows - 1)),
      col_origin_(0.5 * (cols - 1)),
      tile_rows_((rows + tile_side - 1) / tile_side),
      tile_cols_((cols + tile_side - 1) / tile_side),
      cells_(static_cast<std::size_t>(tile_rows_) * tile_cols_ * tile_area, 0.0),
      revisions_(static_cast<std::size_t>(tile_rows_) * tile_cols_, 0) {}

HeightField::HeightField(const HeightGrid& heights, double cell_size)
    : HeightField(static_cast<int>(heights.rows()), static_cast<int>(heights.cols()), cell_size) {
  for (int row = 0; row < rows_; ++row)
    for (int col = 0; col < cols_; ++col) cells_[index(row, col)] = heights(row, col);
}

CellRange HeightField::tile_cells(int tile) const {
  const int row = tile / tile_cols_ * tile_side;
  const int col = tile % tile_cols_ * tile_side;
  return {row, std::min(row + tile_side, rows_), col, std::min(col + tile_side, cols_)};
}

void HeightField::swap_tile(int tile, std::vector<double>& heights) {
  std::swap_ranges(heights.begin(), heights.begin() + tile_area,
                   cells_.begin() + static_cast<std::ptrdiff_t>(tile) * tile_area);
  ++revisions_[tile];
}

HeightGrid HeightField::grid() const {
  HeightGrid heights(rows_, cols_);
  for (int row = 0; row < rows_; ++row)
    for (int col = 0; col < cols_; ++col) heights(row, col) = (*this)(row, col);
  return heights;
}

double HeightField::volume() const {
  CompensatedSum sum;
  for (int row = 0; row < rows_; ++row)
    for (int col = 0; col < cols_; ++col) sum.add((*this)(row, col));
  return sum.value() * cell_area();
}

}  // namespace sandstroke
