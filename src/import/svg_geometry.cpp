#include "import/svg_geometry.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/elementary.h"
#include "core/error.h"
#include "import/text_parts.h"

namespace sandstroke {

using Eigen::Affine2d;
using Eigen::Vector2d;
using std::numbers::pi;

namespace {

/// One function of a transform, "rotate" with its numbers; none if their number is wrong.
std::optional<Affine2d> svg_function(std::string_view name, const std::vector<double>& n) {
  const std::size_t count = n.size();
  Affine2d result = Affine2d::Identity();
  const auto radians = [](double degrees) { return degrees * pi / 180.0; };
  if (name == "matrix" && count == 6) {
    result.linear() << n[0], n[2], n[1], n[3];
    result.translation() << n[4], n[5];
  } else if (name == "translate" && (count == 1 || count == 2)) {
    result.translation() << n[0], count == 2 ? n[1] : 0.0;
  } else if (name == "scale" && (count == 1 || count == 2)) {
    result.linear() << n[0], 0.0, 0.0, count == 2 ? n[1] : n[0];
  } else if (name == "rotate" && (count == 1 || count == 3)) {
    const double c = elementary::cos(radians(n[0])), s = elementary::sin(radians(n[0]));
    result.linear() << c, -s, s, c;
    const Vector2d pivot = count == 3 ? Vector2d(n[1], n[2]) : Vector2d(0.0, 0.0);
    result.translation() = pivot - result.linear() * pivot;
  } else if ((name == "skewX" || name == "skewY") && count == 1) {
    result.linear()(name == "skewX" ? 0 : 1, name == "skewX" ? 1 : 0) = elementary::tan(radians(n[0]));
  } else {
    return {};
  }
  return result;
}

}  // namespace

void SvgNumbers::skip_blanks() {
  rest_.remove_prefix(std::min(rest_.find_first_not_of(" \t\r\n\f,"), rest_.size()));
}

std::optional<double> SvgNumbers::cut() {
  skip_blanks();
  std::string_view text = rest_;
  if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
  double value = 0.0;
  const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (failure != std::errc() || !std::isfinite(value)) return {};
  rest_ = text.substr(static_cast<std::size_t>(end - text.data()));
  return value;
}

std::optional<bool> SvgNumbers::cut_flag() {
  skip_blanks();
  if (!rest_.starts_with('0') && !rest_.starts_with('1')) return {};
  const bool flag = rest_[0] == '1';
  rest_.remove_prefix(1);
  return flag;
}

char SvgNumbers::cut_letter() {
  skip_blanks();
  if (rest_.empty()) return 0;
  const char c = rest_[0];
  if (!((c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'))) return 0;
  rest_.remove_prefix(1);
  return c;
}

bool SvgNumbers::at_end() {
  skip_blanks();
  return rest_.empty();
}

std::optional<double> svg_length(std::string_view text, double whole) {
  SvgNumbers numbers(text);
  const std::optional<double> number = numbers.cut();
  if (!number) return {};
  const struct {
    std::string_view name;
    double px;
  } units[] = {{"", 1.0},           {"px", 1.0},  {"mm", 96.0 / 25.4}, {"cm", 96.0 / 2.54}, {"in", 96.0},
               {"pt", 96.0 / 72.0}, {"pc", 16.0}, {"Q", 96.0 / 101.6}, {"%", 0.01 * whole}};
  const std::string_view unit = without_blanks(numbers.rest());
  for (const auto& one : units)
    if (unit == one.name) return *number * one.px;
  return {};
}

Affine2d svg_transform(std::string_view text, const std::string& location) {
  constexpr std::string_view between = " \t\r\n\f,";
  Affine2d result = Affine2d::Identity();
  std::string_view rest = without_blanks(text);
  if (rest == "none") return result;
  while (!rest.empty()) {
    const std::string_view whole = rest;
    const std::string_view name = without_blanks(cut_before(rest, '('));
    SvgNumbers inside(cut_before(rest, ')'));
    std::vector<double> numbers;
    while (const std::optional<double> number = inside.cut()) numbers.push_back(*number);
    const std::optional<Affine2d> function = svg_function(name, numbers);
    if (!function || !inside.at_end())
      throw_input_error("{}: '{}' is not a transform of SVG; correct it", location, whole.substr(0, 60));
    result = result * *function;
    rest.remove_prefix(std::min(rest.find_first_not_of(between), rest.size()));
  }
  return result;
}

void draw_ellipse_arc(const EllipseArc& arc, const Vector2d& end, const Affine2d& to_mm, DrawnLines& lines) {
  const Vector2d centre = to_mm * arc.centre, a = to_mm.linear() * arc.a, b = to_mm.linear() * arc.b;
  const double bend = elementary::hypot(a.norm(), b.norm()) * arc.sweep * arc.sweep;
  lines.curve_to(to_mm * end, bend, [&](double fraction) -> Vector2d {
    const double angle = arc.start + fraction * arc.sweep;
    return centre + elementary::cos(angle) * a + elementary::sin(angle) * b;
  });
}

}  // namespace sandstroke
