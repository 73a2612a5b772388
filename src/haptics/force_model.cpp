#include "haptics/force_model.h"

#include <cmath>

namespace sandstroke {

double repulse_force(double depth, const ForceSettings& settings) {
  return depth > 0.0 ? settings.k_s * std::expm1(settings.k_c * depth) : 0.0;
}

double depth_of_repulse_force(double force, const ForceSettings& settings) {
  return std::log1p(force / settings.k_s) / settings.k_c;
}

FeltSand felt_sand(double depth, double repulse, double scale, const ForceSettings& settings) {
  if (depth <= 0.0) return {};
  return {scale * settings.k_s * settings.k_c * std::exp(settings.k_c * depth),
          scale * settings.k_f * repulse};
}

SandForce sand_force(double depth, const Eigen::Vector3d& velocity, double max_force,
                     const ForceSettings& settings) {
  SandForce force;
  force.repulse = repulse_force(depth, settings);
  if (force.repulse == 0.0) return force;
  Eigen::Vector3d slip = velocity;
  if (settings.drag == DragDirection::horizontal) slip.z() = 0.0;
  force.drag = -settings.k_f * force.repulse * slip;
  force.total = force.drag + Eigen::Vector3d(0.0, 0.0, force.repulse);
  const double magnitude = force.total.stableNorm();  // squares of huge forces overflow
  if (max_force > 0.0 && magnitude > max_force) {
    force.total *= max_force / magnitude;
    force.saturated = true;
  }
  return force;
}

}  // namespace sandstroke
