#include "sim/device_force.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>

#include "core/angle.h"
#include "core/elementary.h"
#include "haptics/sand_force.h"
#include "sand/region_values.h"
#include "sim/floor_force.h"
#include "sim/scene_ground.h"
#include "tool/tool_surface.h"

namespace sandstroke {
namespace {

/// Equations 1 and 3, of depth and velocity.
class DepthForce : public DeviceForce {
 public:
  explicit DepthForce(const Scene& scene) : settings_(scene.force) {
    if (!scene.ground.has_k_s()) return;
    k_s_ = RegionValues(
        scene.ground.regions, [](const SandRegion& region) { return region.k_s; }, strength_blend(scene));
  }

  Eigen::Vector3d feel(TickRecord& record, const SimulatedDevice& device,
                       DeviceResult& result) const override {
    const SandForce force = force_on_device(record.depth, device, state_of(record.hand),
                                            state_of(record.next), here(record, device.settings()));
    record.repulse_force = {0.0, 0.0, force.repulse};
    record.drag_force = force.drag;
    record.saturated = force.saturated;
    if (force.limited_drag) {
      ++result.limited_drag_ticks;
      result.limited_drag = std::max(result.limited_drag, felt_sand(record, device.settings()).drag);
    }
    return force.total;
  }

  FeltSand felt_sand(const TickRecord& record, const DeviceSettings& device) const override {
    return sandstroke::felt_sand(record.depth, record.repulse_force.z(), device.scale, here(record, device));
  }

  double stored(const TickRecord& record, const DeviceSettings& device) const override {
    return plunge_work(record.depth, device.max_force, here(record, device)) / device.scale;
  }

  Remedy remedy(double max_drag_force) const override {
    Remedy remedy{{"force.k_s"}, ""};
    if (max_drag_force > 0.0) remedy.lower.emplace_back("force.k_f");
    return remedy;
  }

  std::vector<std::string> scales() const override { return {"force.k_s", "force.k_c", "force.k_f"}; }

 private:
  /// The constants of the sand at the tip.
  ForceSettings here(const TickRecord& record, const DeviceSettings& device) const {
    ForceSettings settings = settings_;
    if (!k_s_.empty())
      settings.k_s = k_s_.at(tip_of(device, record.device_position).head<2>(), settings_.k_s);
    return settings;
  }

  ForceSettings settings_;
  RegionValues k_s_;
};

/// Each angle of internal friction [deg] of the scene, by its key.
std::vector<std::pair<std::string, double>> friction_angles_of(const Scene& scene) {
  std::vector<std::pair<std::string, double>> angles = {
      {"force.friction_angle", scene.strength.friction_angle}};
  const auto add = [&](const char* list, const auto& kinds) {
    for (std::size_t i = 0; i < kinds.size(); ++i)
      if (kinds[i].friction_angle)
        angles.emplace_back(fmt::format("{}.{}.friction_angle", list, i + 1), *kinds[i].friction_angle);
  };
  add("sand.region", scene.ground.regions);
  add("sand.layer", scene.ground.layers);
  return angles;
}

/// The wrench of the sand on the tool. Its drag is taken not to grow with speed.
class ContactWrench : public DeviceForce {
 public:
  Eigen::Vector3d feel(TickRecord& record, const SimulatedDevice& device,
                       DeviceResult& /*result*/) const override {
    const Eigen::Vector3d& force = record.wrench.force;
    const double most = device.settings().max_force;
    record.repulse_force = {0.0, 0.0, force.z()};
    record.drag_force = {force.x(), force.y(), 0.0};
    record.saturated = most > 0.0 && record.wrench.whole > most;
    return given(record.wrench, most);
  }

  FeltSand felt_sand(const TickRecord& record, const DeviceSettings& device) const override {
    return {device.scale * record.wrench.limited(device.max_force).stiffness, 0.0};
  }

  double stored(const TickRecord& record, const DeviceSettings& device) const override {
    return given_stored(record.wrench, device.max_force) / device.scale;
  }

  Remedy remedy(double /*max_drag_force*/) const override { return {{"force.density"}, "force.yield"}; }

  /// N, what a device with this maximum gives.
  virtual Eigen::Vector3d given(const Wrench& wrench, double /*max_force*/) const { return wrench.given; }
  /// J, what the sand may give back of that, at most.
  virtual double given_stored(const Wrench& wrench, double /*max_force*/) const {
    return wrench.given_stored;
  }

  /// The theory holds for tools up to 0.4 sqrt(g L) (Agarwal et al. 2023), L the tool's width, and for the
  /// sand that it was fitted for.
  std::string theory_warning(const Scene& scene, double fastest) const override {
    for (const auto& [key, angle] : friction_angles_of(scene)) {
      const double friction = elementary::tan(to_radians(angle));
      if (friction >= 0.3 && friction <= 0.9) continue;
      return fmt::format(
          "{} = {} deg is outside 16.7 to 42 deg, for which the force's constants were fitted; its forces "
          "are "
          "a guess",
          key, angle);
    }
    constexpr double most = 0.4;
    const double length = 2.0 * tool_reach(scene.tool), froude = fastest / std::sqrt(gravity * length);
    if (froude <= most) return "";
    return fmt::format(
        "the tool moves through the sand at {:.3g} m/s, {:.2g} times the square root of g times its width; "
        "the force's theory holds below {} times: the real force is larger",
        fastest, froude, most);
  }
};

/// The wrench by a plugin law, whose keys, theory and energy only the plugin knows.
class PluginWrench : public ContactWrench {
 public:
  Eigen::Vector3d given(const Wrench& wrench, double max_force) const override {
    return wrench.limited(max_force).force;
  }
  double given_stored(const Wrench& wrench, double max_force) const override {
    return wrench.limited(max_force).stored;
  }

  Remedy remedy(double /*max_drag_force*/) const override {
    return {{"the force that model.force gives"}, ""};
  }

  std::string theory_warning(const Scene& /*scene*/, double /*fastest*/) const override { return ""; }
};

std::unique_ptr<DeviceForce> make_law(const Scene& scene) {
  if (!scene.plugin_laws.force.empty()) return std::make_unique<PluginWrench>();
  if (is_contact_law(scene)) return std::make_unique<ContactWrench>();
  return std::make_unique<DepthForce>(scene);
}

}  // namespace

std::unique_ptr<DeviceForce> make_device_force(const Scene& scene) {
  return with_floor(make_law(scene), scene.ground.stiffness);
}

}  // namespace sandstroke
