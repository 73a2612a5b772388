#include "sim/contact_force.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "rules/force.h"
#include "sim/elastic_wrench.h"
#include "tool/tool_surface.h"

namespace sandstroke {
namespace {

/// How far a surface's points lie from its tip [m], at most.
double farthest_from_tip(const TriangleMesh& surface) {
  double most = 0.0;
  for (const Eigen::Vector3d& vertex : surface.vertices) most = std::max(most, length_of(vertex));
  return most;
}

/// A force that goes by the plane of the sand around the tool. The tool feels it by way of an ElasticWrench,
/// and the scene's device gives what another one makes of the limited wrench.
class PlaneForce : public ToolForce {
 public:
  explicit PlaneForce(const Scene& scene)
      : arm_(farthest_from_tip(tool_surface(scene.tool))), device_limit_(scene.device.max_force) {
    if (scene.tool.shape == ToolShape::sphere) sphere_radius_ = scene.tool.radius;
    PlaneForce::turn(own_rotation(scene.tool));
  }

  void lift() override {
    on_tool_.lift();
    on_device_.lift();
    felt_rotation_ = rotation_;
  }
  void turn(const Eigen::Matrix3d& rotation) override { rotation_ = rotation; }

  Wrench feel(const ToolInSand& touch) override {
    const SandPlane plane =
        fit_sand_plane(touch.bed, touch.tip.x(), touch.tip.y(), sphere_radius_.value_or(touch.tool.reach()));
    if (std::isnan(plane.height)) {
      lift();
      return {};
    }
    return elastic(feel_from(plane, touch), touch.motion);
  }

 protected:
  virtual Wrench feel_from(const SandPlane& plane, const ToolInSand& touch) = 0;

  std::optional<double> sphere_radius_;  // m

 private:
  using Six = ElasticWrench::Six;

  /// `wrench` as the law asks for it, and what the tool and the device feel of it after a motion.
  Wrench elastic(Wrench wrench, const Eigen::Vector3d& motion) {
    const Eigen::Matrix3d turn = rotation_ * felt_rotation_.transpose();
    felt_rotation_ = rotation_;
    const Eigen::Vector3d spin(turn(2, 1) - turn(1, 2), turn(0, 2) - turn(2, 0), turn(1, 0) - turn(0, 1));
    Six way, asked;
    way << motion, 0.5 * arm_ * spin;
    const Wrench limited = wrench.limited(device_limit_);
    asked << limited.force, limited.torque / arm_;
    wrench.given = on_device_.follow(asked, limited.stiffness, way, device_limit_).head<3>();
    asked << wrench.force, wrench.torque / arm_;
    const Six& felt = on_tool_.follow(asked, wrench.stiffness, way);
    wrench.force = felt.head<3>();
    wrench.torque = arm_ * felt.tail<3>();
    wrench.stored = on_tool_.stored();
    return wrench;
  }

  double arm_, device_limit_;  // m, N
  Eigen::Matrix3d rotation_, felt_rotation_ = Eigen::Matrix3d::Identity();
  ElasticWrench on_tool_, on_device_;
};

class RftForce : public PlaneForce {
 public:
  RftForce(const Scene& scene, double cell_size)
      : PlaneForce(scene), sand_(scene.strength), resistive_(tool_surface(scene.tool), cell_size) {
    resistive_.turn(own_rotation(scene.tool));
  }

  void lift() override {
    PlaneForce::lift();
    resistive_.lift();
  }
  void turn(const Eigen::Matrix3d& rotation) override {
    PlaneForce::turn(rotation);
    resistive_.turn(rotation);
  }

 private:
  Wrench feel_from(const SandPlane& plane, const ToolInSand& touch) override {
    return resistive_.feel(touch.tool.footprint(), touch.tip, plane, touch.motion, sand_);
  }

  SandStrength sand_;
  ResistiveForce resistive_;
};

class ArchimedesForce : public PlaneForce {
 public:
  ArchimedesForce(const Scene& scene, double cell_size)
      : PlaneForce(scene), sand_(scene.strength), elements_(tool_surface(scene.tool), cell_size) {
    elements_.turn(own_rotation(scene.tool));
  }

  void lift() override {
    PlaneForce::lift();
    sunk_ = 0.0;
  }
  void turn(const Eigen::Matrix3d& rotation) override {
    PlaneForce::turn(rotation);
    elements_.turn(rotation);
  }

 private:
  Wrench feel_from(const SandPlane& plane, const ToolInSand& touch) override {
    constexpr double plate = 0.87574;
    const double yield = sand_.yield_way, per_volume = plate * resistance(sand_);
    sunk_ = std::clamp(sunk_ - touch.motion.z() / yield, 0.0, 1.0);
    const VolumeBelow below = volume_in_sand(touch.tip, plane);
    Wrench wrench;
    wrench.strength = wrench.whole = per_volume * below.volume;
    wrench.force.z() = wrench.strength * sunk_;
    wrench.torque = per_volume * sunk_ * Eigen::Vector3d(below.moment.y(), -below.moment.x(), 0.0);
    wrench.stiffness = per_volume * (below.area + below.volume / yield);  // it grows with volume and way
    return wrench;
  }

  VolumeBelow volume_in_sand(const Eigen::Vector3d& tip, const SandPlane& plane) const {
    if (!sphere_radius_) return volume_below(elements_, plane.height - tip.z(), plane.slope);
    const double R = *sphere_radius_, depth = std::clamp(plane.height - tip.z(), 0.0, 2.0 * R);
    return {std::numbers::pi * depth * depth * (R - depth / 3.0),
            {0.0, 0.0},
            std::numbers::pi * depth * (2.0 * R - depth)};
  }

  SandStrength sand_;
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
