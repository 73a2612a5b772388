#include "sim/contact_force.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "rules/force.h"
#include "sand/sand_plane.h"
#include "sand/strength_by_place.h"
#include "sim/elastic_wrench.h"
#include "sim/scene_ground.h"
#include "tool/tool_surface.h"

namespace sandstroke {
namespace {

/// How far a surface's points lie from its tip [m], at most.
double farthest_from_tip(const TriangleMesh& surface) {
  double most = 0.0;
  for (const Eigen::Vector3d& vertex : surface.vertices) most = std::max(most, length_of(vertex));
  return most;
}

/// How the scene's sand differs by place; none: it is the same everywhere.
std::optional<StrengthByPlace> strength_of(const Scene& scene) {
  if (!scene.ground.has_strengths()) return {};
  return StrengthByPlace(scene.ground, scene.strength, strength_blend(scene));
}

/// The force that a law asks for, as the tool feels it: by way of an ElasticWrench. The scene's device gives
/// what another one makes of the limited wrench.
class ElasticForce : public ToolForce {
 public:
  explicit ElasticForce(const Scene& scene)
      : arm_(farthest_from_tip(tool_surface(scene.tool))),
        device_limit_(scene.device.max_force),
        turns_(scene.tool.shape != ToolShape::sphere) {}

  void lift() override {
    on_tool_.lift();
    on_device_.lift();
    felt_rotation_ = rotation_;
  }
  void turn(const Eigen::Matrix3d& rotation) final {
    if (!turns_) return;
    rotation_ = rotation;
    turn_surface(rotation);
  }

  void visit_state(StateVisitor& state) override {
    state.value("force.rotation", rotation_);
    state.value("force.felt_rotation", felt_rotation_);
    state.value("force.on_tool", on_tool_);
    state.value("force.on_device", on_device_);
    if (state.restores() && turns_) turn_surface(rotation_);
  }

  Wrench feel(const ToolInSand& touch) override {
    const Wrench asked = law(touch);
    if (asked.stiffness > 0.0) return elastic(asked, touch.motion);
    ElasticForce::lift();  // nothing leads; the law knows itself whether the tool touches sand
    return {};
  }

 protected:
  /// Not called for a sphere: its tip stays its lowest point, however the hand turns it.
  virtual void turn_surface(const Eigen::Matrix3d& rotation) = 0;
  /// As the law asks for it; without stiffness where no sand resists.
  virtual Wrench law(const ToolInSand& touch) = 0;

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
    asked << wrench.force, wrench.torque / arm_;
    const Six& felt = on_tool_.follow(asked, wrench.stiffness, way);
    // A device gives no torque, so the hand's turns are free for it, and must give it nothing.
    way.tail<3>().setZero();
    asked << limited.force, Eigen::Vector3d::Zero();
    wrench.given = on_device_.follow(asked, limited.stiffness, way, device_limit_).head<3>();
    wrench.force = felt.head<3>();
    wrench.torque = arm_ * felt.tail<3>();
    wrench.stored = on_tool_.stored();
    wrench.given_stored = on_device_.stored();
    return wrench;
  }

  double arm_, device_limit_;  // m, N
  bool turns_;
  Eigen::Matrix3d rotation_ = Eigen::Matrix3d::Identity(), felt_rotation_ = rotation_;
  ElasticWrench on_tool_, on_device_;
};

class RftForce : public ElasticForce {
 public:
  RftForce(const Scene& scene, double cell_size)
      : ElasticForce(scene),
        sand_(scene.strength),
        places_(strength_of(scene)),
        resistive_(tool_surface(scene.tool), cell_size, scene.relaxation.talus_angle) {
    ElasticForce::turn(own_rotation(scene.tool));
  }
  std::unique_ptr<ToolForce> copy() const override { return std::make_unique<RftForce>(*this); }

  void lift() override {
    ElasticForce::lift();
    resistive_.lift();
  }

  void visit_state(StateVisitor& state) override {
    ElasticForce::visit_state(state);
    resistive_.visit_state(state);
  }

 private:
  void turn_surface(const Eigen::Matrix3d& rotation) override { resistive_.turn(rotation); }
  Wrench law(const ToolInSand& touch) override {
    return resistive_.feel(touch.bed, touch.tool.footprint(), touch.tip, touch.motion, sand_,
                           places_ ? &*places_ : nullptr);
  }

  SandStrength sand_;
  std::optional<StrengthByPlace> places_;
  ResistiveForce resistive_;
};

/// It goes by the plane of the sand around the tool.
class ArchimedesForce : public ElasticForce {
 public:
  ArchimedesForce(const Scene& scene, double cell_size)
      : ElasticForce(scene),
        sand_(scene.strength),
        places_(strength_of(scene)),
        elements_(tool_surface(scene.tool), cell_size) {
    if (scene.tool.shape == ToolShape::sphere && !places_) sphere_radius_ = scene.tool.radius;
    ElasticForce::turn(own_rotation(scene.tool));
  }
  std::unique_ptr<ToolForce> copy() const override { return std::make_unique<ArchimedesForce>(*this); }

  void lift() override {
    ElasticForce::lift();
    sunk_ = 0.0;
  }
  void visit_state(StateVisitor& state) override {
    ElasticForce::visit_state(state);
    state.value("force.sunk", sunk_);
  }

 private:
  void turn_surface(const Eigen::Matrix3d& rotation) override { elements_.turn(rotation); }
  Wrench law(const ToolInSand& touch) override {
    SandPlane plane =
        fit_sand_plane(touch.bed, touch.tip.x(), touch.tip.y(), sphere_radius_.value_or(touch.tool.reach()));
    if (places_) places_->look(elements_, touch.tip);
    if (std::isnan(plane.height)) {
      sunk_ = 0.0;
      return {};
    }
    // No sand is where the floor stands above the tip (Tool::depth).
    plane.height -= touch.tool.sand_level() - (touch.tip.z() + touch.tool.lowest()) - touch.depth;
    constexpr double plate = 0.87574;
    const double yield = sand_.yield_way, per_volume = plate * resistance(sand_);
    sunk_ = std::clamp(sunk_ - touch.motion.z() / yield, 0.0, 1.0);
    const VolumeBelow below = volume_in_sand(touch.tip, plane);
    Wrench wrench;
    wrench.strength = wrench.whole = per_volume * below.volume;
    wrench.force.z() = wrench.strength * sunk_;
    wrench.torque = per_volume * sunk_ * Eigen::Vector3d(below.moment.y(), -below.moment.x(), 0.0);
    // It grows with volume and way; below a border to softer sand the volume may shrink.
    wrench.stiffness = per_volume * (std::abs(below.area) + below.volume / yield);
    return wrench;
  }

  VolumeBelow volume_in_sand(const Eigen::Vector3d& tip, const SandPlane& plane) const {
    if (!sphere_radius_)
      return volume_below(elements_, plane.height - tip.z(), plane.slope, places_ ? &*places_ : nullptr,
                          tip.z());
    const double R = *sphere_radius_, depth = std::clamp(plane.height - tip.z(), 0.0, 2.0 * R);
    return {std::numbers::pi * depth * depth * (R - depth / 3.0),
            {0.0, 0.0},
            std::numbers::pi * depth * (2.0 * R - depth)};
  }

  SandStrength sand_;
  std::optional<StrengthByPlace> places_;
  std::optional<double> sphere_radius_;  // m, where a formula has its volume
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
