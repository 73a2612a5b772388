#include "import/svg_path.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/elementary.h"
#include "core/error.h"
#include "import/svg_geometry.h"

namespace sandstroke {
namespace {

using Eigen::Affine2d;
using Eigen::Vector2d;
using std::numbers::pi;

class SvgPathDrawer {
 public:
  SvgPathDrawer(std::string_view data, const Affine2d& to_mm, const std::string& location, DrawnLines& lines)
      : numbers_(data), to_mm_(to_mm), location_(location), lines_(lines) {}

  void draw() {
    while (!numbers_.at_end()) {
      const std::string_view before = numbers_.rest();
      if (const char letter = numbers_.cut_letter())
        command_ = letter;
      else if (command_ == 'M' || command_ == 'm')  // pairs after those of a move are lines
        command_ = command_ == 'M' ? 'L' : 'l';
      else if (command_ == 'Z' || command_ == 'z')
        complain(before);
      if (last_ == 0 && command_ != 'M' && command_ != 'm') complain(before);
      follow(before);
      last_ = capital();
    }
  }

 private:
  [[noreturn]] void complain(std::string_view at) const {
    throw_input_error("{}: its path data cannot be read at '{}'; correct it", location_, at.substr(0, 40));
  }

  char capital() const { return static_cast<char>(command_ & ~0x20); }
  bool is_relative() const { return command_ != capital(); }

  double number() {
    const std::string_view before = numbers_.rest();
    if (const auto value = numbers_.cut()) return *value;
    complain(before);
  }
  bool flag() {
    const std::string_view before = numbers_.rest();
    if (const auto value = numbers_.cut_flag()) return *value;
    complain(before);
  }
  Vector2d point() {
    const double x = number(), y = number();
    return Vector2d(x, y) + (is_relative() ? at_ : Vector2d(0.0, 0.0));
  }

  void follow(std::string_view before) {
    const Vector2d begin = at_;
    switch (capital()) {
      case 'M':
        at_ = start_ = point();
        lines_.move_to(to_mm_ * at_);
        return;
      case 'Z':
        line(start_);
        lines_.move_to(to_mm_ * at_);
        return;
      case 'L':
        return line(point());
      case 'H':
        return line({number() + (is_relative() ? at_.x() : 0.0), at_.y()});
      case 'V':
        return line({at_.x(), number() + (is_relative() ? at_.y() : 0.0)});
      case 'C':
      case 'S': {
        const Vector2d first = capital() == 'C' ? point() : mirrored(last_ == 'C' || last_ == 'S');
        control_ = point();
        return cubic(begin, first, control_, point());
      }
      case 'Q':
      case 'T':
        control_ = capital() == 'Q' ? point() : mirrored(last_ == 'Q' || last_ == 'T');
        return quadratic(begin, control_, point());
      case 'A':
        return arc();
      default:
        complain(before);
    }
  }

  /// The control point of a smooth curve. after_such: the curve before was of its kind.
  Vector2d mirrored(bool after_such) const { return after_such ? Vector2d(2.0 * at_ - control_) : at_; }

  void line(const Vector2d& end) {
    lines_.line_to(to_mm_ * end);
    at_ = end;
  }

  void cubic(const Vector2d& begin, const Vector2d& first, const Vector2d& second, const Vector2d& end) {
    const Vector2d a = to_mm_ * begin, b = to_mm_ * first, c = to_mm_ * second, d = to_mm_ * end;
    const double bend = 6.0 * std::max((a - 2.0 * b + c).norm(), (b - 2.0 * c + d).norm());
    lines_.curve_to(d, bend, [&](double t) -> Vector2d {
      const double s = 1.0 - t;
      return s * s * s * a + 3.0 * s * s * t * b + 3.0 * s * t * t * c + t * t * t * d;
    });
    at_ = end;
  }

  void quadratic(const Vector2d& begin, const Vector2d& control, const Vector2d& end) {
    const Vector2d a = to_mm_ * begin, b = to_mm_ * control, c = to_mm_ * end;
    lines_.curve_to(c, 2.0 * (a - 2.0 * b + c).norm(), [&](double t) -> Vector2d {
      const double s = 1.0 - t;
      return s * s * a + 2.0 * s * t * b + t * t * c;
    });
    at_ = end;
  }

  /// From end points to the centre: SVG 1.1, F.6.5 and F.6.6.
  void arc() {
    double rx = std::abs(number()), ry = std::abs(number());
    const double turn = number() * pi / 180.0;
    const bool large = flag(), positive = flag();
    const Vector2d end = point();
    if (rx == 0.0 || ry == 0.0 || end == at_) return line(end);
    const Vector2d a(elementary::cos(turn), elementary::sin(turn)), b(-a.y(), a.x());
    const Vector2d half = 0.5 * (at_ - end), on(half.dot(a) / rx, half.dot(b) / ry);  // on the unit circle
    const double square = on.squaredNorm();
    const double grow = std::max(std::sqrt(square), 1.0);  // radii that do not reach are enlarged
    rx *= grow;
    ry *= grow;
    const double off = std::sqrt(std::max(1.0 / square - 1.0, 0.0)) * (large == positive ? -1.0 : 1.0);
    const Vector2d middle = off * Vector2d(on.y(), -on.x());  // of the circle
    const Vector2d from = (on - middle) / grow, to = (-on - middle) / grow;
    EllipseArc curve{0.5 * (at_ + end) + middle.x() / grow * rx * a + middle.y() / grow * ry * b, rx * a,
                     ry * b, elementary::atan2(from.y(), from.x())};
    curve.sweep = elementary::atan2(to.y(), to.x()) - curve.start;
    if (positive && curve.sweep < 0.0) curve.sweep += 2.0 * pi;
    if (!positive && curve.sweep > 0.0) curve.sweep -= 2.0 * pi;
    draw_ellipse_arc(curve, end, to_mm_, lines_);
    at_ = end;
  }

  SvgNumbers numbers_;
  const Affine2d& to_mm_;
  const std::string& location_;
  DrawnLines& lines_;
  char command_ = 0, last_ = 0;  // the last one is a capital; 0: none yet
  Vector2d at_ = Vector2d::Zero(), start_ = Vector2d::Zero(), control_ = Vector2d::Zero();
};

}  // namespace

void draw_svg_path(std::string_view data, const Affine2d& to_mm, const std::string& location,
                   DrawnLines& lines) {
  if (data == "none") return;
  SvgPathDrawer(data, to_mm, location, lines).draw();
}

}  // namespace sandstroke
