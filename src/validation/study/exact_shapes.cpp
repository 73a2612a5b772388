#include "validation/study/exact_shapes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/angle.h"

namespace sandstroke {

double ExactCone::operator()(double x, double y) const {
  return std::max(0.0, slope * (foot - std::max(plateau, std::hypot(x, y))));
}

double ExactCone::volume() const {
  return std::numbers::pi * slope * (foot * foot * foot - plateau * plateau * plateau) / 3.0;
}

ExactCone collapsed_cylinder(double radius, double height, double talus_angle) {
  const double t = talus_slope(talus_angle), width = height / t;  // width of the flank
  if (height >= std::sqrt(3.0) * radius * t) return {t, 0.0, std::cbrt(3.0 * radius * radius * width)};
  const double plateau = (-3.0 * width + std::sqrt(36.0 * radius * radius - 3.0 * width * width)) / 6.0;
  return {t, plateau, plateau + width};
}

ExactCone collapsed_cone(double radius, double height, double talus_angle) {
  const double t = talus_slope(talus_angle);
  return {t, 0.0, std::cbrt(radius * radius * height / t)};
}

double ExactRamp::operator()(double x, double) const {
  return std::clamp(0.5 * height - slope * x, 0.0, height);
}

ExactRamp collapsed_cliff(double height, double talus_angle) { return {talus_slope(talus_angle), height}; }

double ExactTrench::operator()(double x, double) const {
  return std::min(0.0, -slope * (half_width - std::abs(x)));
}

ExactTrench filled_slot(double half_width, double depth, double talus_angle) {
  const double t = talus_slope(talus_angle);
  return {t, std::sqrt(2.0 * half_width * depth / t)};  // the V has the slot's area
}

double ExactCap::top() const { return radius * std::sqrt(1.0 + slope * slope); }

double ExactCap::volume() const {
  const double cosine = radius / top(), sine = slope * cosine;
  return std::numbers::pi * radius * radius * radius / 3.0 *
         (sine * sine * sine * slope - (1.0 - cosine) * (1.0 - cosine) * (2.0 + cosine));
}

double ExactCap::operator()(double x, double y) const {
  const double r = std::hypot(x, y);
  return r < foot() ? top() - slope * r - std::sqrt(radius * radius - r * r) : 0.0;
}

double ExactHeapOnPlate::volume() const {
  const double cosine = std::cos(to_radians(tilt)), sine = std::sin(to_radians(tilt));
  if (sine >= slope * cosine) return 0.0;
  // Places (u, v) on the plate lie at x = u cos, z = -u sin. What is symmetric in v is known from a half.
  constexpr int half = 100, rim_points = 360;
  const double side = radius / half;
  double sum = 0.0;
  for (int row = 0; row < half; ++row)
    for (int col = -half; col < half; ++col) {
      const double u = (col + 0.5) * side, v = (row + 0.5) * side;
      if (std::hypot(u, v) >= radius) continue;
      double height = std::numeric_limits<double>::infinity();
      for (int i = 0; i < rim_points; ++i) {
        const double angle = std::numbers::pi * (i + 0.5) / rim_points, at = radius * std::cos(angle);
        height = std::min(
            height, slope * std::hypot((u - at) * cosine, v - radius * std::sin(angle)) - (at - u) * sine);
      }
      sum += height;
    }
  return 2.0 * sum * side * side * cosine;
}

double ExactSeam::operator()(double x, double) const { return (x < seam ? before : behind) * (seam - x); }

double ExactSeam::mean(double x, double width) const {
  const auto integral = [&](double to) {
    return -0.5 * (to < seam ? before : behind) * (to - seam) * (to - seam);
  };
  return (integral(x + 0.5 * width) - integral(x - 0.5 * width)) / width;
}

double ExactCrater::operator()(double x, double y) const {
  const double distance = law == RelaxationLaw::paper ? octile_distance(x, y) : std::hypot(x, y);
  return std::min(0.0, slope * distance - depth);
}

ExactCrater drained_crater(double depth, double talus_angle, RelaxationLaw law) {
  return {law, talus_slope(talus_angle), depth};
}

double octile_distance(double x, double y) {
  const double far = std::max(std::abs(x), std::abs(y)), near = std::min(std::abs(x), std::abs(y));
  return far + (std::numbers::sqrt2 - 1.0) * near;
}

double plunge_work(double depth, const ForceSettings& force) {
  return force.k_s * (std::expm1(force.k_c * depth) / force.k_c - depth);
}

double drag_work(double depth, double speed, double length, const ForceSettings& force) {
  return force.k_f * speed * repulse_force(depth, force) * length;
}

double strip_fraction_of_disk(double radius, double half_width) {
  const double w = std::min(half_width / radius, 1.0);
  return 2.0 / std::numbers::pi * (w * std::sqrt(1.0 - w * w) + std::asin(w));
}

}  // namespace sandstroke
