#include "sim/contact_force.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tool/tool_surface.h"

namespace sandstroke {

ContactForce::ContactForce(const Scene& scene, double cell_size)
    : law_(scene.force.law), sand_(scene.strength), resistive_(tool_surface(scene.tool), cell_size) {
  resistive_.turn(own_rotation(scene.tool));
  if (scene.tool.shape == ToolShape::sphere) sphere_radius_ = scene.tool.radius;
}

void ContactForce::lift() {
  resistive_.lift();
  sunk_ = 0.0;
}

Wrench ContactForce::feel(const ToolInSand& touch) {
  const SandPlane plane =
      fit_sand_plane(touch.bed, touch.tip.x(), touch.tip.y(), sphere_radius_.value_or(touch.tool.reach()));
  if (std::isnan(plane.height)) {
    lift();
    return {};
  }
  if (law_ == ForceLaw::archimedes) return archimedes(touch.tip, plane, -touch.motion.z());
  return resistive_.feel(touch.tool.footprint(), touch.tip, plane, touch.motion, sand_);
}

VolumeBelow ContactForce::volume_below(const Eigen::Vector3d& tip, const SandPlane& plane) const {
  if (!sphere_radius_) return resistive_.volume_below(tip, plane);
  const double R = *sphere_radius_, depth = std::clamp(plane.height - tip.z(), 0.0, 2.0 * R);
  return {std::numbers::pi * depth * depth * (R - depth / 3.0),
          {0.0, 0.0},
          std::numbers::pi * depth * (2.0 * R - depth)};
}

Wrench ContactForce::archimedes(const Eigen::Vector3d& tip, const SandPlane& plane, double sinks) {
  constexpr double plate = 0.87574;
  const double yield = sand_.yield_way, share = plate * resistance(sand_);
  sunk_ = std::clamp(sunk_ + sinks / yield, 0.0, 1.0);
  const VolumeBelow below = volume_below(tip, plane);
  Wrench wrench;
  wrench.strength = share * below.volume;
  wrench.force.z() = wrench.strength * sunk_;
  wrench.torque = share * sunk_ * Eigen::Vector3d(below.moment.y(), -below.moment.x(), 0.0);
  wrench.stiffness = share * (below.area + below.volume / yield);  // it grows with volume and way
  wrench.stored = 0.5 * yield * wrench.force.z();
  return wrench;
}

}  // namespace sandstroke
