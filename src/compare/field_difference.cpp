#include "compare/field_difference.h"

#include <cmath>
#include <limits>

#include "core/compensated_sum.h"
#include "core/error.h"

namespace sandstroke {

FieldDifference field_difference(const HeightGrid& golden, const HeightGrid& run, double cell_size) {
  if (golden.rows() != run.rows() || golden.cols() != run.cols() || golden.size() == 0) {
    throw_input_error(
        "surfaces of {} x {} and {} x {} cells cannot be subtracted; compare runs of the same bed",
        golden.rows(), golden.cols(), run.rows(), run.cols());
  }
  const int rows = static_cast<int>(golden.rows()), cols = static_cast<int>(golden.cols());
  FieldDifference result;
  CompensatedSum sum, squares;
  const auto mark = [&](int row, int col, double max) {
    result.max = max;
    result.row = row;
    result.col = col;
  };
  for (int row = 0; row < rows; ++row) {
    for (int col = 0; col < cols; ++col) {
      const double difference = run(row, col) - golden(row, col);
      // Two equal infinities subtract to NaN, so that this sees every kind of cell that is not finite.
      if (!std::isfinite(difference)) {
        if (!std::isnan(result.max)) mark(row, col, std::numeric_limits<double>::quiet_NaN());
      } else if (std::abs(difference) > result.max) {  // false once max is NaN
        mark(row, col, std::abs(difference));
      }
      sum.add(difference);
      squares.add(difference * difference);
    }
  }
  result.rms = std::sqrt(squares.value() / static_cast<double>(golden.size()));
  result.volume = sum.value() * cell_size * cell_size;
  const HeightField bed(rows, cols, cell_size);
  result.x = bed.x_of(result.col);
  result.y = bed.y_of(result.row);
  return result;
}

}  // namespace sandstroke
