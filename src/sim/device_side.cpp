#include "sim/device_side.h"

#include <spdlog/fmt/fmt.h>
#include <spdlog/fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.h"

namespace sandstroke {

namespace {

/// What sand and floor returned in a tick along each axis [J]. A tool that glides over a stone is lifted by
/// as much work as it is slowed down with: the floor's force counts with its work as a whole, divided among
/// the axes by its direction.
Eigen::Vector3d returned_along_axes(const TickRecord& record, const Eigen::Vector3d& motion) {
  const double floor = length_of(record.floor_force);
  if (!(floor > 0.0)) return record.device_force.cwiseProduct(motion);
  const Eigen::Vector3d normal = record.floor_force / floor,
                        by_floor = normal.dot(record.device_force) * normal;
  return (record.device_force - by_floor).cwiseProduct(motion) +
         by_floor.dot(motion) * normal.cwiseProduct(normal);
}

}  // namespace

DeviceSide::DeviceSide(const Scene& scene)
    : force_(make_device_force(scene)), device_(scene.device, state_of(Hand{})), late_force_(scene.device) {
  result_.least_passivity_margin = std::numeric_limits<double>::infinity();
}

void DeviceSide::start(const Hand& hand) { device_.put(state_of(hand)); }

double DeviceSide::faded_in(const TickRecord& record) {
  if (lifted_ && record.hand.down) {
    lifted_ = false;
    if (record.contact) {
      fading_since_ = record.time;
      fraction_ = 0.0;
    }
  }
  if (!fading_since_) return 1.0;
  const double fraction = record.contact ? (record.time - *fading_since_) / fade_in : 1.0;
  if (record.contact)
    energy_.give((std::min(fraction, 1.0) - fraction_) * force_->stored(record, device_.settings()));
  fraction_ = fraction;
  if (fraction >= 1.0) fading_since_.reset();
  return std::min(fraction, 1.0);
}

void DeviceSide::check_numbers(const TickRecord& record) const {
  const bool force = record.device_force.allFinite() && record.repulse_force.allFinite() &&
                     record.drag_force.allFinite() && record.floor_force.allFinite() &&
                     record.wrench.torque.allFinite();
  if (force && std::isfinite(record.passivity_margin)) return;
  throw Error(ErrorKind::unstable,
              fmt::format("at {:.4f} s, {:.4g} m deep, the {} is too large for a number; lower {} or the "
                          "stroke's depth",
                          record.time, record.depth, force ? "passivity margin" : "force",
                          fmt::join(force_->scales(), ", ")));
}

void DeviceSide::feel(TickRecord& record) {
  Eigen::Vector3d computed = Eigen::Vector3d::Zero();
  FeltSand felt;
  const double fraction = faded_in(record);
  if (record.contact) {
    computed = fraction * force_->feel(record, device_, result_);
    felt = force_->felt_sand(record, device_.settings());
    result_.max_drag_force = std::max(result_.max_drag_force, length_of(record.drag_force));
  }
  if (record.load > 0.0) bear(computed, record);
  record.device_force = late_force_.act(computed);
  record.dropped = late_force_.dropped();
  record.passivity_margin =
      passivity_margin(felt.stiffness + record.load_stiffness, felt.drag, device_.settings());
  check_numbers(record);
}

/// Gravity draws on what the tool carries as it does on any mass, in contact or not.
void DeviceSide::bear(Eigen::Vector3d& force, TickRecord& record) const {
  record.load_given = record.load;
  force.z() -= record.load;
  const double most = device_.settings().max_force, whole = length_of(force);
  if (!(most > 0.0 && whole > most)) return;
  force *= most / whole;
  record.load_given *= most / whole;
  record.saturated = true;
}

void DeviceSide::move(const TickRecord& record) {
  const Eigen::Vector3d before = device_.state().position;
  device_.advance(state_of(record.hand), state_of(record.next), record.device_force);
  const Eigen::Vector3d motion = device_.state().position - before;
  energy_.add(record.device_force + record.load_given * Eigen::Vector3d::UnitZ(), motion);
  if (device_.settings().model == DeviceModel::dynamic) watch(record, motion);
}

void DeviceSide::watch(const TickRecord& record, const Eigen::Vector3d& motion) {
  const DeviceSettings& d = device_.settings();
  Eigen::Vector3d returned = returned_along_axes(record, motion);
  returned.z() += record.load_given * motion.z();
  if (record.contact) {
    most_stored_ = std::max(most_stored_, force_->stored(record, d));
    const Eigen::Vector3d rounded =
        0.5 * d.resolution * force_->felt_sand(record, d).stiffness * motion.cwiseAbs();
    returned.z() -= rounded.z();
    if (record.floor_depth > 0.0) returned.head<2>() -= rounded.head<2>();
  }
  const Eigen::Vector3d hand = d.servo_rate * (record.next.position - record.hand.position);
  const bool swings = swing_.add(device_.state().velocity - hand, hand, returned, most_stored_, d.mass);
  if (swings && !result_.swings_from) result_.swings_from = record.time;
}

void DeviceSide::advance(const TickRecord& record) {
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
  if (record.floor_depth > 0.0) {
    result_.most_floor_depth = std::max(result_.most_floor_depth, record.floor_depth);
    if (!result_.in_floor_from) result_.in_floor_from = record.time;
  }
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

void DeviceSide::visit_state(StateVisitor& state) {
  device_.visit_state(state);
  late_force_.visit_state(state);
  state.value("device.energy", energy_);
  state.value("device.lifted", lifted_);
  state.value("device.fading_since", fading_since_);
  state.value("device.fraction", fraction_);
  state.value("device.contact_force", contact_force_);
  state.value("device.contact_ticks", contact_ticks_);
  state.value("device.swing", swing_);
  state.value("device.most_stored", most_stored_);
  state.value("device.result", result_);
}

std::string loop_remedies(const Scene& scene, const DeviceResult& result) {
  const DeviceSettings& device = scene.device;
  auto [lower, raise] = make_device_force(scene)->remedy(result.max_drag_force);
  if (result.most_floor_depth > 0.0) lower.emplace_back("ground.stiffness");
  if (device.delay > 0) lower.emplace_back("device.delay");
  if (device.dropped_ticks > 0.0) lower.emplace_back("device.dropped_ticks");
  if (!raise.empty()) raise += " or ";
  return fmt::format("lower {}, or raise {}device.servo_rate or device.damping", fmt::join(lower, " or "),
                     raise);
}

}  // namespace sandstroke
