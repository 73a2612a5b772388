#pragma once

#include <cmath>

namespace sandstroke {

/// Calls visit(row, col, part) for the up to four cells around a point between the middles of cells, given in
/// rows and columns, with the part by which the point belongs to each (bilinear). Cells outside a bed, too.
template <class Visit>
void visit_cells_around(double row, double col, const Visit& visit) {
  const int row_begin = static_cast<int>(std::floor(row)), col_begin = static_cast<int>(std::floor(col));
  for (int corner = 0; corner < 4; ++corner) {
    const int up = corner / 2, right = corner % 2;
    const double part = (up ? row - row_begin : 1.0 - (row - row_begin)) *
                        (right ? col - col_begin : 1.0 - (col - col_begin));
    if (part > 0.0) visit(row_begin + up, col_begin + right, part);
  }
}

}  // namespace sandstroke
