#include "sand/resistive_force.h"

#include <algorithm>
#include <cmath>

#include "core/angle.h"
#include "core/elementary.h"
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

double wedge_reach(const SandStrength& sand) {
  return elementary::tan(to_radians(45.0 + 0.5 * sand.friction_angle));
}

Wrench Wrench::limited(double max_force) const {
  if (!(max_force > 0.0) || strength <= max_force) return *this;
  const double fraction = max_force / strength;
  return {fraction * force, fraction * torque, fraction * stiffness, fraction * stored, max_force};
}

ResistiveForce::ResistiveForce(const TriangleMesh& surface, double element_size)
    : elements_(surface, element_size),
      before_(surface, elements_),
      ways_(hwy::AllocateAligned<double>(3 * elements_.size())) {
  lift();
}

void ResistiveForce::lift() {
  std::fill_n(ways_.get(), 3 * elements_.size(), 0.0);
  before_.lift();
  felt_ = false;
}

Wrench ResistiveForce::feel(const HeightField& bed, const ToolFootprint& footprint,
                            const Eigen::Vector3d& tip, const Eigen::Vector3d& motion,
                            const SandStrength& sand) {
  // An element that is now at r was at (old rotation) (new rotation)^T r.
  const Eigen::Matrix3d& rotation = elements_.rotation();
  SandBefore::Motion ways{motion / sand.yield_way, Eigen::Matrix3d::Zero()};
  if (felt_ && rotation != felt_rotation_)
    ways.spin = (Eigen::Matrix3d::Identity() - felt_rotation_ * rotation.transpose()) / sand.yield_way;
  felt_rotation_ = rotation;
  felt_ = true;
  if (footprint.cells().empty() ||
      !before_.look(bed, footprint, tip, tip.z() + elements_.lowest(), ways, wedge_reach(sand))) {
    lift();
    return {};
  }
  return resistive_wrench(
      {elements_, before_, ways_.get(), tip.z(), ways, resistance(sand), sand.tool_friction, sand.yield_way});
}

}  // namespace sandstroke
