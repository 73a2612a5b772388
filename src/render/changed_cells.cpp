#include "render/changed_cells.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"

namespace sandstroke {

CellRange changed_cells(const HeightGrid& initial, const HeightGrid& final, double threshold) {
  if (initial.rows() != final.rows() || initial.cols() != final.cols())
    throw_input_error(
        "surfaces of {} x {} and {} x {} cells cannot be compared; use two surfaces of the same bed",
        initial.cols(), initial.rows(), final.cols(), final.rows());
  CellRange range{static_cast<int>(initial.rows()), 0, static_cast<int>(initial.cols()), 0};
  for (int row = 0; row < initial.rows(); ++row) {
    for (int col = 0; col < initial.cols(); ++col) {
      if (!(std::abs(final(row, col) - initial(row, col)) > threshold)) continue;
      range.row_begin = std::min(range.row_begin, row);
      range.row_end = std::max(range.row_end, row + 1);
      range.col_begin = std::min(range.col_begin, col);
      range.col_end = std::max(range.col_end, col + 1);
    }
  }
  return range.empty() ? CellRange{} : range;
}

}  // namespace sandstroke
