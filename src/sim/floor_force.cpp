#include "sim/floor_force.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>

#include "core/error.h"
#include "haptics/passivity.h"

namespace sandstroke {
namespace {

class OnFloor : public DeviceForce {
 public:
  OnFloor(std::unique_ptr<DeviceForce> law, double stiffness) : law_(std::move(law)), stiffness_(stiffness) {}

  Eigen::Vector3d feel(TickRecord& record, const SimulatedDevice& device,
                       DeviceResult& result) const override {
    const Eigen::Vector3d by_sand = law_->feel(record, device, result);
    if (!pushes(record)) return by_sand;
    const Eigen::Vector3d both = by_sand + record.floor_force;
    const double most = device.settings().max_force, size = length_of(both);
    if (most == 0.0 || size <= most) return both;
    record.saturated = true;
    return most / size * both;
  }

  FeltSand felt_sand(const TickRecord& record, const DeviceSettings& device) const override {
    FeltSand felt = law_->felt_sand(record, device);
    if (pushes(record)) felt.stiffness += device.scale * stiffness_;
    return felt;
  }

  double stored(const TickRecord& record, const DeviceSettings& device) const override {
    const double by_sand = law_->stored(record, device);
    if (!pushes(record)) return by_sand;
    const double force = stiffness_ * record.floor_depth,
                 most = device.max_force > 0.0 ? std::min(force, device.max_force) : force;
    return by_sand + most * (record.floor_depth - 0.5 * most / stiffness_) / device.scale;
  }

  Remedy remedy(double max_drag_force) const override { return law_->remedy(max_drag_force); }
  std::vector<std::string> scales() const override { return law_->scales(); }
  std::string theory_warning(const Scene& scene, double fastest) const override {
    return law_->theory_warning(scene, fastest);
  }

 private:
  bool pushes(const TickRecord& record) const { return stiffness_ > 0.0 && record.floor_depth > 0.0; }

  std::unique_ptr<DeviceForce> law_;
  double stiffness_;  // N/m
};

}  // namespace

std::unique_ptr<DeviceForce> with_floor(std::unique_ptr<DeviceForce> law, double stiffness) {
  return std::make_unique<OnFloor>(std::move(law), stiffness);
}

void check_floor_stiffness(const Scene& scene, const std::string& name) {
  const DeviceSettings& device = scene.device;
  if (device.model != DeviceModel::dynamic || !scene.ground.is_solid() ||
      passivity_margin(device.scale * scene.ground.stiffness, 0.0, device) > 0.0)
    return;
  const double bound =
      passivity_margin(0.0, 0.0, device) * device.servo_rate / (0.5 + device.delay) / device.scale;
  throw_input_error(
      "{}: ground.stiffness = {} N/m: the device's loop would create energy at a stone; take less than "
      "{:.4g} "
      "N/m, or raise device.servo_rate or device.damping{}",
      name, scene.ground.stiffness, bound, device.delay > 0 ? ", or lower device.delay" : "");
}

}  // namespace sandstroke
