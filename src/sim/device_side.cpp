#include "sim/device_side.h"

#include <algorithm>
#include <limits>

#include "core/error.h"
#include "haptics/sand_force.h"

namespace sandstroke {
namespace {

SimulatedDevice::State as_state(const Hand& hand) { return {hand.position, hand.velocity}; }

}  // namespace

DeviceSide::DeviceSide(const ForceSettings& force, const DeviceSettings& device)
    : force_(force),
      device_(device, as_state(Hand{})),
      late_force_(device),
      least_margin_(std::numeric_limits<double>::infinity()) {}

void DeviceSide::start(const Hand& hand) { device_.put(as_state(hand)); }

double DeviceSide::faded_in(const TickRecord& record) {
  if (lifted_ && record.hand.down) {
    lifted_ = false;
    if (record.contact) fading_since_ = record.time, share_ = 0.0;
  }
  if (!fading_since_) return 1.0;
  const double share = record.contact ? (record.time - *fading_since_) / fade_in : 1.0;
  const DeviceSettings& d = device_.settings();
  if (record.contact)
    energy_.give((std::min(share, 1.0) - share_) * plunge_work(record.depth, d.max_force, force_) / d.scale);
  share_ = share;
  if (share >= 1.0) fading_since_.reset();
  return std::min(share, 1.0);
}

void DeviceSide::feel(TickRecord& record) {
  Eigen::Vector3d computed = Eigen::Vector3d::Zero();
  const double share = faded_in(record);
  if (record.contact) {
    const SandForce force =
        force_on_device(record.depth, device_, as_state(record.hand), as_state(record.next), force_);
    record.repulse_force = {0.0, 0.0, force.repulse};
    record.drag_force = force.drag;
    record.saturated = force.saturated;
    computed = share * force.total;
  }
  record.device_force = late_force_.act(computed);
  record.passivity_margin = passivity_margin(record.contact ? record.depth : 0.0, record.repulse_force.z(),
                                             force_, device_.settings());
}

void DeviceSide::move(const TickRecord& record) {
  const Eigen::Vector3d before = device_.state().position;
  device_.advance(as_state(record.hand), as_state(record.next), record.device_force);
  energy_.add(record.device_force, device_.state().position - before);
}

void DeviceSide::advance(const TickRecord& record) {
  if (!record.device_force.allFinite())
    throw Error(ErrorKind::unstable,
                fmt::format("at {:.4f} s, {:.4g} m deep, the force is too large for a number; lower "
                            "force.k_s, force.k_c, force.k_f or the stroke's depth",
                            record.time, record.depth));
  if (record.lifts) {
    start(record.next);
    late_force_.clear();
    lifted_ = true;
  } else {
    move(record);
  }
  const double force = length_of(record.device_force);
  max_force_ = std::max(max_force_, force);
  saturated_ticks_ += record.saturated;
  if (!record.contact) return;
  contact_ticks_ += 1;
  contact_force_.add(force);
  least_margin_ = std::min(least_margin_, record.passivity_margin);
}

DeviceResult DeviceSide::result() const {
  const bool contact = contact_ticks_ > 0;
  return {saturated_ticks_,
          max_force_,
          contact ? contact_force_.value() / static_cast<double>(contact_ticks_) : 0.0,
          energy_.absorbed(),
          energy_.least(),
          contact ? least_margin_ : passivity_margin(0.0, 0.0, force_, device_.settings())};
}

}  // namespace sandstroke
