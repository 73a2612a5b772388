#include "sand/resistive_force.h"

#include <algorithm>
#include <cmath>

#include "core/angle.h"
#include "core/elementary.h"
#include "rules/force.h"
#include "sand/resistive_kernels.h"

namespace sandstroke {

void apply_sand_preset(SandStrength& sand) {
  sand.friction_angle = sand.preset == SandPreset::quikrete ? 34.0 : 30.0;
  sand.density = 1560.0;
}

double resistance(const SandStrength& sand) {
  constexpr double gravity = 9.81;  // m/s^2
  const double mu = elementary::tan(to_radians(sand.friction_angle));
  return sand.density * gravity * (((894.0 * mu - 386.0) * mu + 89.0) * mu);
}

Wrench Wrench::limited(double max_force) const {
  if (!(max_force > 0.0) || strength <= max_force) return *this;
  const double size = std::max(whole, length_of(force));
  const double of_force = size > max_force ? max_force / size : 1.0, of_stiffness = max_force / strength;
  Wrench weaker = *this;
  weaker.force *= of_force;
  weaker.torque *= of_force;
  weaker.stiffness *= of_stiffness;
  weaker.stored *= of_force * of_force / of_stiffness;  // force^2 / (2 stiffness)
  weaker.strength = max_force;
  weaker.whole = std::min(whole, max_force);
  return weaker;
}

ResistiveForce::ResistiveForce(const TriangleMesh& surface, double element_size)
    : elements_(surface, element_size), ways_(hwy::AllocateAligned<double>(3 * elements_.size())) {
  lift();
}

void ResistiveForce::lift() {
  std::fill_n(ways_.get(), 3 * elements_.size(), 0.0);
  felt_ = false;
}

Wrench ResistiveForce::feel(const ToolFootprint& footprint, const Eigen::Vector3d& tip,
                            const SandPlane& plane, const Eigen::Vector3d& motion, const SandStrength& sand) {
  if (footprint.cells().empty() || std::isnan(plane.height)) {
    lift();
    return {};
  }
  // An element that is now at r was at (old rotation) (new rotation)^T r.
  const Eigen::Matrix3d& rotation = elements_.rotation();
  Eigen::Matrix3d spin = Eigen::Matrix3d::Zero();
  if (felt_ && rotation != felt_rotation_)
    spin = (Eigen::Matrix3d::Identity() - felt_rotation_ * rotation.transpose()) / sand.yield_way;
  felt_rotation_ = rotation;
  felt_ = true;
  return resistive_wrench({footprint, elements_, ways_.get(), tip, plane, motion / sand.yield_way, spin,
                           resistance(sand), sand.tool_friction, sand.yield_way});
}

}  // namespace sandstroke
