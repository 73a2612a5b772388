#include "validation/stress/device_loop.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <limits>

#include "haptics/sand_force.h"

namespace sandstroke {
namespace {

using State = SimulatedDevice::State;

/// The force on the device at rest [N].
Eigen::Vector3d force_at_rest(const LoopSettings& settings) {
  if (const auto* yielding = std::get_if<YieldingSand>(&settings.against))
    return {0.0, 0.0, YieldingSand::fraction_at_rest * yielding->strength};
  const auto* sand = std::get_if<PressedSand>(&settings.against);
  if (!sand) return Eigen::Vector3d::Zero();
  const double drag = felt_about_rest(settings).x.damping;
  return {-drag * sand->speed, 0.0, repulse_force(sand->depth, sand->force)};
}

State rest_of(const LoopSettings& settings) {
  const auto* sand = std::get_if<PressedSand>(&settings.against);
  if (!sand) return {Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
  return {{0.0, 0.0, -sand->depth / settings.device.scale}, {sand->speed, 0.0, 0.0}};
}

State disturbed(const LoopSettings& settings) {
  State state = rest_of(settings);
  state.position.z() += settings.disturbance;
  if (std::holds_alternative<PressedSand>(settings.against)) state.position.x() += settings.disturbance;
  return state;
}

}  // namespace

LoopSettings with_gain(LoopSettings settings, double gain) {
  if (auto* wall = std::get_if<Wall>(&settings.against)) {
    wall->stiffness *= gain;
    wall->damping *= gain;
  } else if (auto* yielding = std::get_if<YieldingSand>(&settings.against)) {
    yielding->strength *= gain;
  } else {
    std::get<PressedSand>(settings.against).force.k_s *= gain;
  }
  return settings;
}

FeltAlong felt_about_rest(const LoopSettings& settings) {
  if (const auto* wall = std::get_if<Wall>(&settings.against)) return {{}, *wall};
  if (const auto* yielding = std::get_if<YieldingSand>(&settings.against))
    return {{}, {settings.device.scale * yielding->strength / yielding->yield, 0.0}};
  const auto& [force, depth, speed] = std::get<PressedSand>(settings.against);
  const FeltSand sand = felt_sand(depth, repulse_force(depth, force), settings.device.scale, force);
  return {{0.0, sand.drag}, {sand.stiffness, force.drag == DragDirection::full ? sand.drag : 0.0}};
}

DeviceLoop::DeviceLoop(const LoopSettings& settings)
    : settings_(settings),
      rest_(rest_of(settings)),
      lead_(Eigen::Vector3d::Zero()),
      device_(settings.device, disturbed(settings)),
      late_force_(settings.device, force_at_rest(settings)),
      force_(force_at_rest(settings)),
      read_z_(rest_.position.z()) {
  // At rest the hand's spring balances sand and damping: k_h lead = b v - F.
  const DeviceSettings& d = settings.device;
  const Eigen::Vector3d from_hand = d.damping * rest_.velocity - force_;
  if (!from_hand.isZero(0.0)) lead_ = from_hand / d.hand_stiffness;
}

State DeviceLoop::hand_at(std::int64_t tick) const {
  const double time = static_cast<double>(tick) / settings_.device.servo_rate;
  return {rest_.position + lead_ + time * rest_.velocity, rest_.velocity};
}

Eigen::Vector3d DeviceLoop::off_rest() const {
  return device_.state().position - (hand_at(tick_).position - lead_);
}

Eigen::Vector3d DeviceLoop::heading_off_rest() const {
  return off_rest() + (device_.state().velocity - rest_.velocity) / settings_.device.servo_rate;
}

Eigen::Vector3d DeviceLoop::force_now(const State& hand, const State& next) {
  const State reading = device_.read();
  if (const auto* wall = std::get_if<Wall>(&settings_.against))
    return {0.0, 0.0, -wall->stiffness * reading.position.z() - wall->damping * reading.velocity.z()};
  if (const auto* yielding = std::get_if<YieldingSand>(&settings_.against)) {
    const double way = settings_.device.scale * (read_z_ - reading.position.z()) / yielding->yield;
    yielded_ = std::clamp(yielded_ + way, -1.0, 1.0);
    read_z_ = reading.position.z();
    return {0.0, 0.0, yielded_ * yielding->strength};
  }
  const double depth = -settings_.device.scale * reading.position.z();
  return force_on_device(depth, device_, hand, next, std::get<PressedSand>(settings_.against).force).total;
}

void DeviceLoop::tick() {
  const State hand = hand_at(tick_), next = hand_at(tick_ + 1);
  force_ = late_force_.act(force_now(hand, next));
  device_.advance(hand, next, force_);
  ++tick_;
}

LoopRun run_loop(const LoopSettings& settings, std::int64_t ticks) {
  constexpr std::size_t windows = 16;
  const std::int64_t window = std::max<std::int64_t>(ticks / static_cast<std::int64_t>(windows), 1);
  std::array<double, windows> swing{};
  DeviceLoop loop(settings);
  LoopRun run;
  for (std::size_t w = 0; w < windows; ++w) {
    Eigen::AlignedBox3d positions;
    for (std::int64_t k = 0; k < window; ++k) {
      positions.extend(loop.heading_off_rest());
      loop.tick();
      if (!(loop.off_rest().cwiseAbs().maxCoeff() < settings.far)) {  // NaN also counts as far
        const double infinite = std::numeric_limits<double>::infinity();
        return {Verdict::diverged, infinite, infinite};
      }
    }
    swing[w] = positions.sizes().maxCoeff();
    run.swing = swing[w];
    run.growth = swing[w] / swing[w / 2];
    run.verdict = Verdict::stable;
    if (swing[w] <= 1e-4 * settings.disturbance) return run;
  }
  const bool falls = run.growth < 0.5 && run.swing < 0.95 * swing[windows - 2];
  if (falls || run.swing <= settings.device.resolution) return run;
  const bool grows = std::holds_alternative<Wall>(settings.against) && run.growth > 2.0;
  run.verdict = grows ? Verdict::diverged : Verdict::limit_cycle;
  return run;
}

}  // namespace sandstroke
