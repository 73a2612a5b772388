#include "import/drawn_lines.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "import/sample_checks.h"

namespace sandstroke {

using Eigen::Vector2d;

DrawnLines::DrawnLines(const std::string& name) : name_(name) {
  table_.line_tolerance = drawing_line_tolerance;
  table_.columns = {{"x", "mm", {}}, {"y", "mm", {}}};
}

void DrawnLines::move_to(const Vector2d& point) {
  at_ = point;
  begins_ = true;
}

void DrawnLines::line_to(const Vector2d& point) {
  if (begins_) {
    if (!table_.lifts.empty()) table_.lifts.back() = true;
    ++lines_;
    add(at_);
    begins_ = false;
  }
  if (point != at_) add(point);  // a dot is a line of one sample
  at_ = point;
}

void DrawnLines::add(const Vector2d& point) {
  constexpr double farthest = 1e12;  // mm
  if (!(point.cwiseAbs().maxCoeff() <= farthest))
    throw_input_error("{}: line {} has a point more than {:g} mm away; correct it or its transform", name_,
                      lines_, farthest);
  if (static_cast<double>(table_.lifts.size()) >= most_curve_points)
    throw_input_error("{}: has more than {:g} points up to line {}; split the file", name_, most_curve_points,
                      lines_);
  table_.columns[0].values.push_back(point.x());
  table_.columns[1].values.push_back(point.y());
  table_.lifts.push_back(false);
}

/// A chord over the fraction h is off by at most h^2 bend / 8.
double DrawnLines::pieces(double bend) const {
  const double tolerance = std::max(drawing_curve_tolerance, drawing_curve_fraction * bend);
  return std::isfinite(bend) ? std::max(std::ceil(std::sqrt(bend / (8.0 * tolerance))), 1.0) : 1.0;
}

SampleTable DrawnLines::table(const std::string& format) const {
  if (table_.lifts.empty()) throw_input_error("{}: has no lines to draw; give a file with a path", name_);
  SampleTable table = table_;
  table.lifts.back() = true;
  const auto size = [&](std::size_t axis) {
    const auto& values = table.columns[axis].values;
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    return *high - *low;
  };
  table.description = fmt::format("{}: {} pen strokes, {} points, {:.4g} x {:.4g} mm", format, lines_,
                                  table.size(), size(0), size(1));
  return table;
}

}  // namespace sandstroke
