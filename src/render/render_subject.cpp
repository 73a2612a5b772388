#include "render/render_subject.h"

#include <algorithm>
#include <cmath>

namespace sandstroke {

CellRange framed_cells(const CellRange& focus, int rows, int cols, double cell_size, double margin) {
  if (focus.empty()) return {0, rows, 0, cols};
  const int larger = std::max(focus.rows(), focus.cols());
  const int grow = static_cast<int>(std::ceil(std::max(0.1 * larger, margin / cell_size)));
  return {std::max(0, focus.row_begin - grow), std::min(rows, focus.row_end + grow),
          std::max(0, focus.col_begin - grow), std::min(cols, focus.col_end + grow)};
}

ValueRange value_range(double least, double greatest, bool diverging) {
  if (diverging) {
    const double most = std::max(std::abs(least), std::abs(greatest));
    return most > 0.0 ? ValueRange{-most, most} : ValueRange{-5e-4, 5e-4};
  }
  return greatest > least ? ValueRange{least, greatest} : ValueRange{least - 5e-4, least + 5e-4};
}

}  // namespace sandstroke
