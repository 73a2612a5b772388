#include "sim/contact_force.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "sand/sand_plane.h"
#include "tool/tool_surface.h"

namespace sandstroke {
namespace {

class RftForce : public ToolForce {
 public:
  RftForce(const Scene& scene, double cell_size)
      : sand_(scene.strength), resistive_(tool_surface(scene.tool), cell_size) {
    resistive_.turn(own_rotation(scene.tool));
  }

  Wrench feel(const ToolInSand& touch) override {
    return resistive_.feel(touch.bed, touch.tool.footprint(), touch.tip, touch.motion, sand_);
  }
  void lift() override { resistive_.lift(); }
  void turn(const Eigen::Matrix3d& rotation) override { resistive_.turn(rotation); }

 private:
  SandStrength sand_;
  ResistiveForce resistive_;
};

/// It goes by the plane of the sand around the tool.
class ArchimedesForce : public ToolForce {
 public:
  ArchimedesForce(const Scene& scene, double cell_size)
      : sand_(scene.strength), elements_(tool_surface(scene.tool), cell_size) {
    if (scene.tool.shape == ToolShape::sphere) sphere_radius_ = scene.tool.radius;
    elements_.turn(own_rotation(scene.tool));
  }

  Wrench feel(const ToolInSand& touch) override {
    const SandPlane plane =
        fit_sand_plane(touch.bed, touch.tip.x(), touch.tip.y(), sphere_radius_.value_or(touch.tool.reach()));
    if (std::isnan(plane.height)) {
      lift();
      return {};
    }
    constexpr double plate = 0.87574;
    const double yield = sand_.yield_way, per_volume = plate * resistance(sand_);
    sunk_ = std::clamp(sunk_ - touch.motion.z() / yield, 0.0, 1.0);
    const VolumeBelow below = volume_in_sand(touch.tip, plane);
    Wrench wrench;
    wrench.strength = per_volume * below.volume;
    wrench.force.z() = wrench.strength * sunk_;
    wrench.torque = per_volume * sunk_ * Eigen::Vector3d(below.moment.y(), -below.moment.x(), 0.0);
    wrench.stiffness = per_volume * (below.area + below.volume / yield);  // it grows with volume and way
    wrench.stored = 0.5 * yield * wrench.force.z();
    return wrench;
  }
  void lift() override { sunk_ = 0.0; }
  void turn(const Eigen::Matrix3d& rotation) override { elements_.turn(rotation); }

 private:
  VolumeBelow volume_in_sand(const Eigen::Vector3d& tip, const SandPlane& plane) const {
    if (!sphere_radius_) return volume_below(elements_, plane.height - tip.z(), plane.slope);
    const double R = *sphere_radius_, depth = std::clamp(plane.height - tip.z(), 0.0, 2.0 * R);
    return {std::numbers::pi * depth * depth * (R - depth / 3.0),
            {0.0, 0.0},
            std::numbers::pi * depth * (2.0 * R - depth)};
  }

  SandStrength sand_;
  std::optional<double> sphere_radius_;  // m
  ToolElements elements_;
  double sunk_ = 0.0;  // yield ways, 0 to 1
};

}  // namespace

std::unique_ptr<ToolForce> make_contact_force(const Scene& scene, double cell_size) {
  switch (scene.force.law) {
    case ForceLaw::rft:
      return std::make_unique<RftForce>(scene, cell_size);
    case ForceLaw::archimedes:
      return std::make_unique<ArchimedesForce>(scene, cell_size);
    case ForceLaw::paper:
      break;
  }
  return std::make_unique<NoToolForce>();
}

}  // namespace sandstroke
