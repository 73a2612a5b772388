#include "import/gcode_arc.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/elementary.h"
#include "core/error.h"
#include "import/gcode.h"

namespace sandstroke {

using Eigen::Vector2d;
using std::numbers::pi;

double GcodeArc::chords() const {
  const double fraction = std::max(gcode_arc_fraction, gcode_arc_tolerance / std::max(radius, end_radius));
  const double step = 2.0 * elementary::acos(std::max(1.0 - fraction, 0.0));
  return std::ceil(std::abs(sweep) / step);
}

double GcodeArc::length(double climb) const {
  return elementary::hypot(0.5 * (radius + end_radius) * sweep, end_radius - radius, climb);
}

Vector2d GcodeArc::at(double fraction) const {
  const double angle = start + fraction * sweep;
  return centre +
         std::lerp(radius, end_radius, fraction) * Vector2d(elementary::cos(angle), elementary::sin(angle));
}

GcodeArc arc_between(const Vector2d& begin, const Vector2d& end, const Vector2d& centre, bool clockwise,
                     const std::string& location) {
  const Vector2d from = begin - centre, to = end - centre;
  GcodeArc arc;
  arc.centre = centre;
  arc.radius = from.norm();
  arc.end_radius = to.norm();
  if (!(arc.radius >= 1e-6 && arc.radius <= gcode_farthest))
    throw_input_error("{}: the arc's radius is {:g} mm; correct I and J, or R", location, arc.radius);
  const double off = std::abs(arc.radius - arc.end_radius);
  if (!(off <= 0.5 && off <= std::max(0.005, 0.001 * arc.radius))) {
    throw_input_error(
        "{}: the arc begins {:g} mm from its centre and ends {:g} mm from it; correct X, Y, I or J", location,
        arc.radius, arc.end_radius);
  }
  arc.start = elementary::atan2(from.y(), from.x());
  arc.sweep = elementary::atan2(to.y(), to.x()) - arc.start;
  constexpr double nothing = 5e-7;  // rad; a smaller sweep means a whole turn
  if (!clockwise && arc.sweep <= nothing) arc.sweep += 2.0 * pi;
  if (clockwise && arc.sweep >= -nothing) arc.sweep -= 2.0 * pi;
  return arc;
}

Vector2d centre_by_radius(const Vector2d& begin, const Vector2d& end, double radius, bool clockwise,
                          const std::string& location) {
  const Vector2d way = end - begin;
  const double half = 0.5 * way.norm();
  if (half == 0.0) throw_input_error("{}: the arc with R ends where it begins; give I and J", location);
  if (half > std::abs(radius) * (1.0 + 1e-4) + 0.005)
    throw_input_error("{}: R is {:g} mm, too small for an arc between points {:g} mm apart; correct it",
                      location, std::abs(radius), 2.0 * half);
  const double height = std::sqrt(std::max(radius * radius - half * half, 0.0));
  const Vector2d left = Vector2d(-way.y(), way.x()) / (2.0 * half);
  const bool centre_left = !clockwise == (radius > 0.0);
  return begin + 0.5 * way + (centre_left ? height : -height) * left;
}

}  // namespace sandstroke
