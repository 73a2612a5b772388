#include "sweep/slopes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/angle.h"
#include "core/compensated_sum.h"
#include "core/elementary.h"

namespace sandstroke {

double descent_slope(const HeightField& bed, int row, int col) {
  // Round the cell, beginning and ending east; beyond a wall there is no way down.
  constexpr int row_steps[] = {0, 1, 1, 1, 0, -1, -1, -1, 0}, col_steps[] = {1, 1, 0, -1, -1, -1, 0, 1, 1};
  double drops[9];
  const double here = bed(row, col);
  for (int i = 0; i < 9; ++i) {
    const int r = row + row_steps[i], c = col + col_steps[i];
    const bool inside = r >= 0 && r < bed.rows() && c >= 0 && c < bed.cols();
    drops[i] = inside ? here - bed(r, c) : std::numeric_limits<double>::quiet_NaN();
  }
  double steepest = 0.0;  // squared
  for (int i = 0; i < 8; ++i) {
    const double to_axis = drops[i + i % 2], to_diagonal = drops[i + 1 - i % 2];
    const double onwards = to_diagonal - to_axis;  // from the axis neighbour to the diagonal one
    // The triangle's own slope where that leads down within it, otherwise along its nearer side, where that
    // leads down.
    const double square = onwards < 0.0       ? to_axis * std::max(0.0, to_axis)
                          : onwards > to_axis ? 0.5 * to_diagonal * std::max(0.0, to_diagonal)
                                              : to_axis * to_axis + onwards * onwards;
    if (square > steepest) steepest = square;
  }
  return std::sqrt(steepest) / bed.cell_size();
}

double law_slope(const HeightField& bed, int row, int col, RelaxationLaw law) {
  const auto drop = [&](int row_step, int col_step) {
    const int r = row + row_step, c = col + col_step;
    const bool inside = r >= 0 && r < bed.rows() && c >= 0 && c < bed.cols();
    return inside ? std::max(0.0, bed(row, col) - bed(r, c)) : 0.0;
  };
  const double x = std::max(drop(0, -1), drop(0, 1)), y = std::max(drop(-1, 0), drop(1, 0));
  if (law == RelaxationLaw::isotropic) return elementary::hypot(x, y) / bed.cell_size();
  const double diagonal = std::max({drop(-1, -1), drop(-1, 1), drop(1, -1), drop(1, 1)});
  return std::max({x, y, diagonal / std::numbers::sqrt2}) / bed.cell_size();
}

SlopeMeasures measure_slopes(const HeightField& initial, const HeightField& final,
                             const RelaxationSettings& settings) {
  CompensatedSum sum;
  double steepest = 0.0, law_steepest = 0.0, changed = 0.0, at_talus = 0.0;
  visit_cells_of_both(initial, final, [&](int row, int col, double before, double after) {
    if (before == after) return;
    const double angle = to_degrees(std::atan(descent_slope(final, row, col)));
    sum.add(angle);
    steepest = std::max(steepest, angle);
    changed += 1.0;
    at_talus += std::abs(angle - settings.talus_angle) <= 1.0;
    law_steepest = std::max(law_steepest, law_slope(final, row, col, settings.law));
  });
  if (changed == 0.0) return {};
  return {sum.value() / changed, steepest, to_degrees(std::atan(law_steepest)), at_talus / changed};
}

}  // namespace sandstroke
