#include "validation/study/surface_error.h"

#include <algorithm>
#include <cmath>

#include "core/angle.h"
#include "core/compensated_sum.h"

namespace sandstroke {

SurfaceError surface_error(const HeightGrid& heights, const HeightGrid& start, const HeightGrid& exact) {
  CompensatedSum difference, square, moved;
  double largest = 0.0;
  for (Eigen::Index i = 0; i < heights.size(); ++i) {
    const double error = std::abs(heights.data()[i] - exact.data()[i]);
    difference.add(error);
    square.add(error * error);
    moved.add(std::abs(exact.data()[i] - start.data()[i]));
    largest = std::max(largest, error);
  }
  return {difference.value() / moved.value(), std::sqrt(square.value() / static_cast<double>(heights.size())),
          largest};
}

SurfaceError surface_error(const HeightField& bed, const HeightField& start, const ExactSurface& exact) {
  HeightGrid expected(bed.rows(), bed.cols());
  for (int row = 0; row < bed.rows(); ++row)
    for (int col = 0; col < bed.cols(); ++col) expected(row, col) = exact(bed.x_of(col), bed.y_of(row));
  return surface_error(bed.grid(), start.grid(), expected);
}

namespace {

constexpr int directions = 36;

/// Computes the slope of the least-squares line through points added one by one.
class LineFit {
 public:
  void add(double x, double y) {
    ++count_;
    x_ += x;
    y_ += y;
    xx_ += x * x;
    xy_ += x * y;
  }
  double slope() const { return (count_ * xy_ - x_ * y_) / (count_ * xx_ - x_ * x_); }

 private:
  double count_ = 0.0, x_ = 0.0, y_ = 0.0, xx_ = 0.0, xy_ = 0.0;
};

}  // namespace

std::vector<double> flank_directions() {
  std::vector<double> angles(directions);
  for (int i = 0; i < directions; ++i) angles[i] = 360.0 / directions * i;
  return angles;
}

std::vector<double> flank_slope_errors(const HeightField& bed, const Flank& flank) {
  const double near = std::lerp(flank.inner, flank.outer, 0.2),
               far = std::lerp(flank.inner, flank.outer, 0.8);
  std::vector<LineFit> sectors(directions);
  for (int row = 0; row < bed.rows(); ++row)
    for (int col = 0; col < bed.cols(); ++col) {
      const double x = bed.x_of(col), y = bed.y_of(row), distance = std::hypot(x, y);
      if (distance < near || distance > far) continue;
      const double turn = std::atan2(y, x) / to_radians(360.0 / directions);
      sectors[(static_cast<int>(std::lround(turn)) + directions) % directions].add(distance, bed(row, col));
    }
  std::vector<double> errors;
  for (const LineFit& sector : sectors)
    errors.push_back(to_degrees(std::atan(std::abs(sector.slope())) - std::atan(flank.slope)));
  return errors;
}

double slope_along(const HeightField& bed, double direction, double low, double high) {
  const double col_step = std::cos(to_radians(direction)), row_step = std::sin(to_radians(direction));
  constexpr double step = 0.25;  // cells
  LineFit line;
  for (double way = 0.0;; way += step) {  // cells
    const double row = bed.row_at(0.0) + way * row_step, col = bed.col_at(0.0) + way * col_step;
    if (!(row >= 0.0 && row < bed.rows() - 1 && col >= 0.0 && col < bed.cols() - 1)) break;
    const int i = static_cast<int>(row), j = static_cast<int>(col);
    const double z = std::lerp(std::lerp(bed(i, j), bed(i, j + 1), col - j),
                               std::lerp(bed(i + 1, j), bed(i + 1, j + 1), col - j), row - i);
    if (z >= low && z <= high) line.add(way * bed.cell_size(), z);
  }
  return to_degrees(std::atan(-line.slope()));
}

}  // namespace sandstroke
