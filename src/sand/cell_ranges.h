#pragma once

#include <algorithm>

#include "sand/bed_geometry.h"

namespace sandstroke {

/// The cells that both hold; may be empty().
inline CellRange common(const CellRange& a, const CellRange& b) {
  return {std::max(a.row_begin, b.row_begin), std::min(a.row_end, b.row_end),
          std::max(a.col_begin, b.col_begin), std::min(a.col_end, b.col_end)};
}

/// The smallest rectangle that holds both. Either may be empty().
inline CellRange around(const CellRange& a, const CellRange& b) {
  if (a.empty()) return b;
  if (b.empty()) return a;
  return {std::min(a.row_begin, b.row_begin), std::max(a.row_end, b.row_end),
          std::min(a.col_begin, b.col_begin), std::max(a.col_end, b.col_end)};
}

/// `by` more cells on each side; may reach beyond the bed.
inline CellRange grown(const CellRange& cells, int by) {
  return {cells.row_begin - by, cells.row_end + by, cells.col_begin - by, cells.col_end + by};
}

/// The smallest rectangle that holds all of `cells` where change(row, col) is true.
template <class Change>
CellRange changed_part(const CellRange& cells, Change change) {
  CellRange part;
  for (int row = cells.row_begin; row < cells.row_end; ++row) {
    int first = cells.col_begin, last = cells.col_end;
    while (first < last && !change(row, first)) ++first;
    while (last > first && !change(row, last - 1)) --last;
    part = around(part, {row, row + 1, first, last});
  }
  return part;
}

}  // namespace sandstroke
