#include "compare/field_difference.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/compensated_sum.h"
#include "core/error.h"

namespace sandstroke {

namespace {

[[noreturn]] void refuse(Eigen::Index golden_rows, Eigen::Index golden_cols, Eigen::Index rows,
                         Eigen::Index cols) {
  throw_input_error(
      "surfaces of {} x {} and {} x {} cells (x, y) cannot be subtracted; compare runs of the same bed",
      golden_cols, golden_rows, cols, rows);
}

/// Calls visit(row, col, run - golden) for every cell of every tile in which the two may differ. Two equal
/// infinities give NaN, so no value is missed that is not finite.
template <class Visit>
void visit_differences(const HeightField& golden, const HeightField& run, const Visit& visit) {
  if (golden.rows() != run.rows() || golden.cols() != run.cols() || golden.rows() == 0 || golden.cols() == 0)
    refuse(golden.rows(), golden.cols(), run.rows(), run.cols());
  visit_cells_of_both(golden, run, [&](int row, int col, double a, double b) { visit(row, col, b - a); });
}

}  // namespace

FieldDifference field_difference(const HeightField& golden, const HeightField& run) {
  FieldDifference result;
  CompensatedSum sum, squares;
  // Keeps the largest, and of equal ones the first, row by row. A cell that is not finite beats any number.
  const auto compare = [&](int row, int col, double difference) {
    const bool finite = std::isfinite(difference), was_finite = !std::isnan(result.max);
    const bool earlier = row < result.row || (row == result.row && col < result.col);
    const double size = std::abs(difference);
    const bool worse =
        finite ? was_finite && (size > result.max || (size == result.max && size > 0.0 && earlier))
               : was_finite || earlier;
    if (!worse) return;
    result.max = finite ? size : std::numeric_limits<double>::quiet_NaN();
    result.row = row;
    result.col = col;
  };
  visit_differences(golden, run, [&](int row, int col, double difference) {
    compare(row, col, difference);
    result.cells += difference != 0.0;
    sum.add(difference);
    squares.add(difference * difference);
  });
  result.rms = std::sqrt(squares.value() / (static_cast<double>(golden.rows()) * golden.cols()));
  result.volume = sum.value() * golden.cell_area();
  result.x = golden.x_of(result.col);
  result.y = golden.y_of(result.row);
  return result;
}

FieldDifference field_difference(const HeightGrid& golden, const HeightGrid& run, double cell_size) {
  if (golden.size() == 0 || run.size() == 0) refuse(golden.rows(), golden.cols(), run.rows(), run.cols());
  return field_difference(HeightField(golden, cell_size), HeightField(run, cell_size));
}

CellRange differing_cells(const HeightField& golden, const HeightField& run, double limit) {
  CellRange range{golden.rows(), 0, golden.cols(), 0};
  visit_differences(golden, run, [&](int row, int col, double difference) {
    if (std::abs(difference) <= limit) return;
    range.row_begin = std::min(range.row_begin, row);
    range.row_end = std::max(range.row_end, row + 1);
    range.col_begin = std::min(range.col_begin, col);
    range.col_end = std::max(range.col_end, col + 1);
  });
  return range.empty() ? CellRange{} : range;
}

}  // namespace sandstroke
