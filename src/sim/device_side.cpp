#include "sim/device_side.h"

#include <spdlog/fmt/fmt.h>
#include <spdlog/fmt/ranges.h>

#include <algorithm>
#include <limits>
#include <vector>

#include "core/error.h"
#include "haptics/sand_force.h"

namespace sandstroke {
namespace {

SimulatedDevice::State as_state(const Hand& hand) { return {hand.position, hand.velocity}; }

}  // namespace

DeviceSide::DeviceSide(const Scene& scene)
    : force_(scene.force),
      of_contact_(is_contact_law(scene)),
      device_(scene.device, as_state(Hand{})),
      late_force_(scene.device) {
  result_.least_passivity_margin = std::numeric_limits<double>::infinity();
}

void DeviceSide::start(const Hand& hand) { device_.put(as_state(hand)); }

double DeviceSide::faded_in(const TickRecord& record) {
  if (lifted_ && record.hand.down) {
    lifted_ = false;
    if (record.contact) fading_since_ = record.time, share_ = 0.0;
  }
  if (!fading_since_) return 1.0;
  const double share = record.contact ? (record.time - *fading_since_) / fade_in : 1.0;
  if (record.contact) energy_.give((std::min(share, 1.0) - share_) * stored(record));
  share_ = share;
  if (share >= 1.0) fading_since_.reset();
  return std::min(share, 1.0);
}

double DeviceSide::stored(const TickRecord& record) const {
  const DeviceSettings& d = device_.settings();
  const double of_sand = of_contact_ ? record.wrench.limited(d.max_force).stored
                                     : plunge_work(record.depth, d.max_force, force_);
  return of_sand / d.scale;
}

double DeviceSide::stiffness(const TickRecord& record) const {
  const double scale = device_.settings().scale;
  return of_contact_ ? scale * record.wrench.limited(device_.settings().max_force).stiffness
                     : felt_sand(record.depth, 0.0, scale, force_).stiffness;
}

void DeviceSide::feel_contact(TickRecord& record, double share, Eigen::Vector3d& computed) {
  const Eigen::Vector3d& force = record.wrench.force;
  const double most = device_.settings().max_force;
  record.repulse_force = {0.0, 0.0, force.z()};
  record.drag_force = {force.x(), force.y(), 0.0};
  record.saturated = most > 0.0 && record.wrench.strength > most;
  result_.max_drag_force = std::max(result_.max_drag_force, length_of(record.drag_force));
  computed = share * record.wrench.limited(most).force;
}

void DeviceSide::feel_paper(TickRecord& record, double share, Eigen::Vector3d& computed) {
  const SandForce force =
      force_on_device(record.depth, device_, as_state(record.hand), as_state(record.next), force_);
  record.repulse_force = {0.0, 0.0, force.repulse};
  record.drag_force = force.drag;
  record.saturated = force.saturated;
  result_.max_drag_force = std::max(result_.max_drag_force, length_of(force.drag));
  if (force.held_drag) {
    ++result_.held_drag_ticks;
    result_.held_drag = std::max(
        result_.held_drag, felt_sand(record.depth, force.repulse, device_.settings().scale, force_).drag);
  }
  computed = share * force.total;
}

void DeviceSide::feel(TickRecord& record) {
  Eigen::Vector3d computed = Eigen::Vector3d::Zero();
  const double share = faded_in(record);
  if (record.contact)
    of_contact_ ? feel_contact(record, share, computed) : feel_paper(record, share, computed);
  record.device_force = late_force_.act(computed);
  record.dropped = late_force_.dropped();
  if (of_contact_)  // no drag that grows with speed
    record.passivity_margin =
        passivity_margin(record.contact ? stiffness(record) : 0.0, 0.0, device_.settings());
  else
    record.passivity_margin = passivity_margin(record.contact ? record.depth : 0.0, record.repulse_force.z(),
                                               force_, device_.settings());
}

void DeviceSide::move(const TickRecord& record) {
  const Eigen::Vector3d before = device_.state().position;
  device_.advance(as_state(record.hand), as_state(record.next), record.device_force);
  const Eigen::Vector3d motion = device_.state().position - before;
  energy_.add(record.device_force, motion);
  if (device_.settings().model == DeviceModel::dynamic) watch(record, motion);
}

void DeviceSide::watch(const TickRecord& record, const Eigen::Vector3d& motion) {
  const DeviceSettings& d = device_.settings();
  Eigen::Vector3d returned = record.device_force.cwiseProduct(motion);
  if (record.contact) {
    most_stored_ = std::max(most_stored_, stored(record));
    returned.z() -= 0.5 * d.resolution * stiffness(record) * std::abs(motion.z());
  }
  const Eigen::Vector3d hand = d.servo_rate * (record.next.position - record.hand.position);
  const bool swings = swing_.add(device_.state().velocity - hand, hand, returned, most_stored_, d.mass);
  if (swings && !result_.swings_from) result_.swings_from = record.time;
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
    swing_ = {};
    lifted_ = true;
  } else {
    move(record);
  }
  const double force = length_of(record.device_force);
  result_.max_force = std::max(result_.max_force, force);
  result_.saturated_ticks += record.saturated;
  if (!record.contact) return;
  contact_ticks_ += 1;
  contact_force_.add(force);
  result_.least_passivity_margin = std::min(result_.least_passivity_margin, record.passivity_margin);
}

DeviceResult DeviceSide::result() const {
  DeviceResult result = result_;
  result.absorbed_energy = energy_.absorbed();
  result.least_absorbed_energy = energy_.least();
  if (contact_ticks_ > 0)
    result.mean_force = contact_force_.value() / static_cast<double>(contact_ticks_);
  else
    result.least_passivity_margin = passivity_margin(0.0, 0.0, device_.settings());
  return result;
}

std::string loop_remedies(const Scene& scene, double max_drag_force) {
  const DeviceSettings& device = scene.device;
  const bool paper = !is_contact_law(scene), own = !scene.own.force.empty();
  std::vector<std::string> lower = {own ? "what model.force gives" : paper ? "force.k_s" : "force.density"};
  if (paper && max_drag_force > 0.0) lower.emplace_back("force.k_f");
  if (device.delay > 0) lower.emplace_back("device.delay");
  if (device.dropped_ticks > 0.0) lower.emplace_back("device.dropped_ticks");
  return fmt::format("lower {}, or raise {}device.servo_rate or device.damping", fmt::join(lower, " or "),
                     paper || own ? "" : "force.yield or ");
}

}  // namespace sandstroke
