#include "sim/device_force.h"

#include <algorithm>

#include "haptics/sand_force.h"

namespace sandstroke {
namespace {

/// Equations 1 and 3, of depth and velocity.
class DepthForce : public DeviceForce {
 public:
  explicit DepthForce(const ForceSettings& settings) : settings_(settings) {}

  Eigen::Vector3d feel(TickRecord& record, const SimulatedDevice& device,
                       DeviceResult& result) const override {
    const SandForce force =
        force_on_device(record.depth, device, state_of(record.hand), state_of(record.next), settings_);
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
    return sandstroke::felt_sand(record.depth, record.repulse_force.z(), device.scale, settings_);
  }

  double stored(const TickRecord& record, const DeviceSettings& device) const override {
    return plunge_work(record.depth, device.max_force, settings_) / device.scale;
  }

  Remedy remedy(double max_drag_force) const override {
    Remedy remedy{{"force.k_s"}, ""};
    if (max_drag_force > 0.0) remedy.lower.emplace_back("force.k_f");
    return remedy;
  }

 private:
  ForceSettings settings_;
};

/// The wrench of the sand on the tool, by any other law. Its drag is taken not to grow with speed.
class ContactWrench : public DeviceForce {
 public:
  explicit ContactWrench(bool by_plugin) : by_plugin_(by_plugin) {}

  Eigen::Vector3d feel(TickRecord& record, const SimulatedDevice& device,
                       DeviceResult& /*result*/) const override {
    const Eigen::Vector3d& force = record.wrench.force;
    const double most = device.settings().max_force;
    record.repulse_force = {0.0, 0.0, force.z()};
    record.drag_force = {force.x(), force.y(), 0.0};
    record.saturated = most > 0.0 && record.wrench.strength > most;
    return record.wrench.limited(most).force;
  }

  FeltSand felt_sand(const TickRecord& record, const DeviceSettings& device) const override {
    return {device.scale * record.wrench.limited(device.max_force).stiffness, 0.0};
  }

  double stored(const TickRecord& record, const DeviceSettings& device) const override {
    return record.wrench.limited(device.max_force).stored / device.scale;
  }

  Remedy remedy(double /*max_drag_force*/) const override {
    if (by_plugin_) return {{"the force that model.force gives"}, ""};
    return {{"force.density"}, "force.yield"};
  }

 private:
  bool by_plugin_;
};

}  // namespace

std::unique_ptr<DeviceForce> make_device_force(const Scene& scene) {
  if (is_contact_law(scene)) return std::make_unique<ContactWrench>(!scene.plugin_laws.force.empty());
  return std::make_unique<DepthForce>(scene.force);
}

}  // namespace sandstroke
