#include "sweep/slopes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/angle.h"
#include "core/compensated_sum.h"
#include "core/elementary.h"
#include "sand/ground.h"

namespace sandstroke {
namespace {

bool is_inside(const HeightField& bed, int row, int col) {
  return row >= 0 && row < bed.rows() && col >= 0 && col < bed.cols();
}

/// The drop [m] to a neighbour. 0 beyond the border.
double drop(const HeightField& bed, int row, int col, int down, int right) {
  return is_inside(bed, row + down, col + right) ? bed(row, col) - bed(row + down, col + right) : 0.0;
}

}  // namespace

double descent_slope(const HeightField& bed, int row, int col) {
  // The neighbours around the cell, from east to east. Beyond the border there is no way down.
  constexpr int row_steps[] = {0, 1, 1, 1, 0, -1, -1, -1, 0}, col_steps[] = {1, 1, 0, -1, -1, -1, 0, 1, 1};
  double drops[9];
  const double here = bed(row, col);
  for (int i = 0; i < 9; ++i) {
    const int r = row + row_steps[i], c = col + col_steps[i];
    drops[i] = is_inside(bed, r, c) ? here - bed(r, c) : std::numeric_limits<double>::quiet_NaN();
  }
  double steepest = 0.0;  // squared
  for (int i = 0; i < 8; ++i) {
    const double to_axis = drops[i + i % 2], to_diagonal = drops[i + 1 - i % 2];
    const double onwards = to_diagonal - to_axis;  // from the axis neighbour to the diagonal one
    // The triangle's slope, if its steepest way down lies within the triangle. Otherwise the slope of its
    // nearer side, if that leads down.
    const double square = onwards < 0.0       ? to_axis * std::max(0.0, to_axis)
                          : onwards > to_axis ? 0.5 * to_diagonal * std::max(0.0, to_diagonal)
                                              : to_axis * to_axis + onwards * onwards;
    if (square > steepest) steepest = square;
  }
  return std::sqrt(steepest) / bed.cell_size();
}

namespace {

/// RelaxationLaw::faces: the slope of the steepest face through which the cell may give.
double steepest_face(const HeightField& bed, int row, int col) {
  const auto across = [&](int r, int c, int down, int right) {
    const bool both = is_inside(bed, r + down, c + right) && is_inside(bed, r - down, c - right);
    return (drop(bed, r, c, -down, -right) - drop(bed, r, c, down, right)) / (both ? 2.0 : 1.0);
  };
  double steepest = 0.0;
  for (const auto& [down, right] : {std::pair(0, -1), std::pair(0, 1), std::pair(-1, 0), std::pair(1, 0)}) {
    const double fall = drop(bed, row, col, down, right),
                 behind = std::max(0.0, drop(bed, row, col, -down, -right));
    if (!(fall > 0.0)) continue;
    const double low = std::min(fall, behind);
    const double sideways = 0.5 * (across(row, col, std::abs(right), std::abs(down)) +
                                   across(row + down, col + right, std::abs(right), std::abs(down)));
    steepest =
        std::max(steepest, elementary::hypot(fall + low * low / (3.0 * std::max(fall, behind)), sideways));
  }
  return steepest / bed.cell_size();
}

}  // namespace

double law_slope(const HeightField& bed, int row, int col, RelaxationLaw law) {
  if (law == RelaxationLaw::faces) return steepest_face(bed, row, col);
  const auto fall = [&](int down, int right) { return std::max(0.0, drop(bed, row, col, down, right)); };
  const double x = std::max(fall(0, -1), fall(0, 1)), y = std::max(fall(-1, 0), fall(1, 0));
  if (law == RelaxationLaw::isotropic) return elementary::hypot(x, y) / bed.cell_size();
  const double diagonal = std::max({fall(-1, -1), fall(-1, 1), fall(1, -1), fall(1, 1)});
  return std::max({x, y, diagonal / std::numbers::sqrt2}) / bed.cell_size();
}

namespace {

/// The talus angle of a cell's sand [deg].
double talus_of(const HeightField& bed, int row, int col, double elsewhere) {
  return bed.ground() ? to_degrees(std::atan(bed.ground()->talus_slopes(row, col))) : elsewhere;
}

}  // namespace

SlopeMeasures measure_slopes(const HeightField& initial, const HeightField& final,
                             const RelaxationSettings& settings) {
  CompensatedSum sum;
  double steepest = 0.0, law_steepest = 0.0, changed = 0.0, at_talus = 0.0;
  visit_cells_of_both(initial, final, [&](int row, int col, double before, double after) {
    if (before == after || after == final.floor(row, col)) return;
    const double angle = to_degrees(std::atan(descent_slope(final, row, col)));
    sum.add(angle);
    steepest = std::max(steepest, angle);
    changed += 1.0;
    at_talus += std::abs(angle - talus_of(final, row, col, settings.talus_angle)) <= 1.0;
    law_steepest = std::max(law_steepest, law_slope(final, row, col, settings.law));
  });
  if (changed == 0.0) return {};
  return {sum.value() / changed, steepest, to_degrees(std::atan(law_steepest)), at_talus / changed};
}

}  // namespace sandstroke
