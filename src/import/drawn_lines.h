#pragma once

#include <Eigen/Core>
#include <string>

#include "import/sample_table.h"

namespace sandstroke {

/// How far the chords of a drawing's curves may be off them [mm], and for large curves this fraction of the
/// second derivative (of a circle of radius r: 1e-5 r).
inline constexpr double drawing_curve_tolerance = 0.002;
inline constexpr double drawing_curve_fraction = 2.5e-7;
/// How far the tip may be off the lines and corners of a drawing [mm].
inline constexpr double drawing_line_tolerance = 0.01;

/// Collects the lines of a drawing in mm, y up, as samples. The pen lifts where a new line begins. Error of
/// each function: input, if points are too many or too far away.
class DrawnLines {
 public:
  /// `name` stands for the file in messages.
  explicit DrawnLines(const std::string& name);

  /// A new line begins there, once the next function draws it.
  void move_to(const Eigen::Vector2d& point);
  void line_to(const Eigen::Vector2d& point);
  /// A curve from the last point: `at` gives its point at a fraction of it, of which the second derivative is
  /// at most `bend` [mm].
  template <class Curve>
  void curve_to(const Eigen::Vector2d& end, double bend, const Curve& at) {
    const double count = pieces(bend);
    for (double k = 1.0; k < count; ++k) line_to(at(k / count));
    line_to(end);
  }

  const Eigen::Vector2d& at() const { return at_; }
  std::size_t lines() const { return lines_; }
  /// The samples, with their number, lines and size as description. Error: input, if nothing is drawn.
  SampleTable table(const std::string& format) const;

 private:
  double pieces(double bend) const;
  void add(const Eigen::Vector2d& point);

  std::string name_;
  Eigen::Vector2d at_ = Eigen::Vector2d::Zero();
  bool begins_ = true;  // the next line is a new one
  std::size_t lines_ = 0;
  SampleTable table_;
};

}  // namespace sandstroke
