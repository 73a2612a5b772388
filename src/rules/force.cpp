#include "rules/force.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/elementary.h"

namespace sandstroke {

namespace {

/// 0 times infinity is 0 here, not NaN.
double product(double a, double b) { return a == 0.0 || b == 0.0 ? 0.0 : a * b; }

}  // namespace

double repulse_force(double depth, const ForceSettings& settings) {
  return depth > 0.0 ? product(settings.k_s, elementary::expm1(settings.k_c * depth)) : 0.0;
}

double depth_of_repulse_force(double force, const ForceSettings& settings) {
  return elementary::log1p(force / settings.k_s) / settings.k_c;
}

double plunge_work(double depth, double max_force, const ForceSettings& settings) {
  if (depth <= 0.0 || settings.k_s == 0.0) return 0.0;
  const double limited_from =
      max_force > 0.0 ? depth_of_repulse_force(max_force, settings) : std::numeric_limits<double>::infinity();
  const double d = std::min(depth, limited_from);
  const double work = settings.k_s * (elementary::expm1(settings.k_c * d) / settings.k_c - d);
  return depth > limited_from ? work + max_force * (depth - limited_from) : work;
}

FeltSand felt_sand(double depth, double repulse, double scale, const ForceSettings& settings) {
  if (depth <= 0.0) return {};
  return {product(scale * settings.k_s * settings.k_c, elementary::exp(settings.k_c * depth)),
          product(scale * settings.k_f, repulse)};
}

SandForce sand_force(double depth, const Eigen::Vector3d& velocity, double max_force,
                     const ForceSettings& settings) {
  SandForce force;
  force.repulse = repulse_force(depth, settings);
  if (force.repulse == 0.0) return force;
  Eigen::Vector3d dragged = velocity;
  if (settings.drag == DragDirection::horizontal) dragged.z() = 0.0;
  const double drag = product(settings.k_f, force.repulse);
  force.drag = -dragged.unaryExpr([drag](double speed) { return product(drag, speed); });
  force.total = force.drag + Eigen::Vector3d(0.0, 0.0, force.repulse);
  const bool within = force.total.allFinite() && length_of(force.total) <= max_force;
  if (max_force > 0.0 && !within) {
    // The forces overflow, too, at a depth beyond any sense; their direction does not depend on it.
    const Eigen::Vector3d direction = Eigen::Vector3d::UnitZ() - settings.k_f * dragged;
    force.total = max_force * (direction.allFinite() ? direction.stableNormalized()
                                                     : Eigen::Vector3d(-dragged.stableNormalized()));
    force.saturated = true;
  }
  return force;
}

}  // namespace sandstroke
