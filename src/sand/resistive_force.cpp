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
  const double mu = elementary::tan(to_radians(sand.friction_angle));
  return sand.density * gravity * (((894.0 * mu - 386.0) * mu + 89.0) * mu);
}

double wedge_reach(double talus_angle) { return elementary::tan(to_radians(45.0 + 0.5 * talus_angle)); }

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

ResistiveForce::ResistiveForce(const TriangleMesh& surface, double element_size, double talus_angle)
    : elements_(surface, element_size),
      before_(surface, elements_),
      wedge_(wedge_reach(talus_angle)),
      ways_(3 * elements_.size()) {
  lift();
}

void ResistiveForce::lift() {
  std::fill(ways_.begin(), ways_.end(), 0.0);
  before_.lift();
  felt_ = false;
}

Wrench ResistiveForce::feel(const HeightField& bed, const ToolFootprint& footprint,
                            const Eigen::Vector3d& tip, const Eigen::Vector3d& motion,
                            const SandStrength& sand, StrengthByPlace* places) {
  // An element that is now at r was at (old rotation) (new rotation)^T r.
  const Eigen::Matrix3d& rotation = elements_.rotation();
  SandBefore::Motion ways{motion / sand.yield_way, Eigen::Matrix3d::Zero(), sand.yield_way};
  if (felt_ && rotation != felt_rotation_)
    ways.spin = (Eigen::Matrix3d::Identity() - felt_rotation_ * rotation.transpose()) / sand.yield_way;
  felt_rotation_ = rotation;
  felt_ = true;
  if (footprint.cells().empty() ||
      !before_.look(bed, footprint, tip, tip.z() + elements_.lowest(), ways, wedge_)) {
    lift();
    return {};
  }
  if (places) places->look(elements_, tip);
  return resistive_wrench(
      {elements_, before_, ways_.data(), tip.z(), ways, resistance(sand), sand.tool_friction, places});
}

}  // namespace sandstroke
