#include "validation/stress/loop_theory.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "core/bisection.h"
#include "haptics/loop_stability.h"
#include "haptics/passivity.h"

namespace sandstroke {
namespace {

constexpr double band = 0.05;     // half width about the boundary, as a fraction of the gain
constexpr double shown_by = 3.0;  // growth or decay over a run's second half that shows on which side it is
constexpr double least_ticks = 4e3, most_ticks = 3e5;

/// The factors (k_x, k_v) of the force -k_x x - k_v v.
Eigen::RowVector2d feedback(const DeviceSettings& device, const Eigen::Matrix<double, 2, 5>& map,
                            const Wall& felt, bool implicit) {
  if (!implicit) return {felt.stiffness, felt.damping};
  const double g = map(0, 4) * felt.damping;
  const double fraction = felt.damping / (g + std::max(1.0 / device.servo_rate, g));
  return {felt.stiffness + fraction * (map(0, 0) - 1.0 - map(0, 4) * felt.stiffness), fraction * map(0, 1)};
}

/// The loop's one-tick map along an axis (haptics/loop_stability.h).
Eigen::MatrixXd loop_map(const LoopSettings& settings, const Wall& felt) {
  const DeviceSettings& device = settings.device;
  const bool by_encoders = device.velocity == ReadVelocity::encoders;
  if (by_encoders && std::holds_alternative<PressedSand>(settings.against))
    return loop_map(
        device, windowed_feedback({felt.stiffness, felt.damping}, device.velocity_window, device.servo_rate));
  const bool implicit =
      device.drag == DragVelocity::implicit && std::holds_alternative<PressedSand>(settings.against);
  return loop_map(device, feedback(device, device_tick_map(device), felt, implicit));
}

double spectral_radius(const LoopSettings& settings, const Wall& felt) {
  return sandstroke::spectral_radius(loop_map(settings, felt));
}

/// Logarithm of the growth per tick at this gain.
double growth_at(const LoopSettings& settings, double gain) {
  const LoopSettings changed = with_gain(settings, gain);
  return std::log(settings.device.dropped_ticks > 0.0 ? mean_growth_with_drops(changed)
                                                      : spectral_radius(changed));
}

}  // namespace

double spectral_radius(const LoopSettings& settings) {
  const FeltAlong felt = felt_about_rest(settings);
  const double along_z = spectral_radius(settings, felt.z);
  if (std::holds_alternative<Wall>(settings.against)) return along_z;
  return std::max(spectral_radius(settings, felt.x), along_z);
}

double exact_boundary_gain(const LoopSettings& settings) {
  return boundary_of_positive([&](double gain) { return spectral_radius(with_gain(settings, gain)) < 1.0; });
}

double passivity_margin(const LoopSettings& settings) {
  const DeviceSettings& device = settings.device;
  const FeltAlong felt = felt_about_rest(settings);
  return std::min(passivity_margin(felt.x.stiffness, felt.x.damping, device),
                  passivity_margin(felt.z.stiffness, felt.z.damping, device));
}

double oldest_force(const DeviceSettings& device, std::int64_t ticks) {
  int row = 0, longest = 0;
  for (std::int64_t k = 0; k < ticks; ++k) {
    row = drops_tick(k, device.dropped_ticks) ? row + 1 : 0;
    longest = std::max(longest, row);
  }
  return (1.0 + device.delay + longest) / device.servo_rate;
}

double margin_by_age(const LoopSettings& settings, std::int64_t ticks) {
  const DeviceSettings& device = settings.device;
  return device.damping + device.hand_damping -
         felt_about_rest(settings).z.stiffness * oldest_force(device, ticks);
}

double mean_growth_with_drops(const LoopSettings& settings) {
  constexpr int first = 1'000, ticks = 20'000;  // the first ones turn the state to the fastest growth
  const Wall felt = felt_about_rest(settings).z;
  const Eigen::Matrix<double, 2, 5> map = device_tick_map(settings.device);
  Eigen::Matrix3d dropped = Eigen::Matrix3d::Identity();
  dropped.topRows<2>() << map.leftCols<2>(), map.col(4);
  Eigen::Matrix3d fresh = Eigen::Matrix3d::Zero();
  fresh.bottomLeftCorner<1, 2>() << -felt.stiffness, -felt.damping;
  fresh.topLeftCorner<2, 2>() = map.leftCols<2>() + map.col(4) * fresh.bottomLeftCorner<1, 2>();
  std::mt19937 random(1);  // not the sequence of drops_tick
  Eigen::Vector3d state(1.0, 0.0, -felt.stiffness);
  double logarithm = 0.0;
  for (int k = -first; k < ticks; ++k) {
    const bool late = 0x1p-32 * static_cast<double>(random()) < settings.device.dropped_ticks;
    state = ((late ? dropped : fresh) * state).eval();
    const double size = state.cwiseAbs().maxCoeff();
    state /= size;
    if (k >= 0) logarithm += std::log(size);
  }
  return std::exp(logarithm / ticks);
}

double swing_of_encoders(const LoopSettings& settings) {
  const Wall felt = felt_about_rest(settings).z;
  const Eigen::MatrixXd loop = loop_map(settings, felt);
  Eigen::VectorXd state = Eigen::VectorXd::Zero(loop.rows());
  state.head<2>() = device_tick_map(settings.device).col(4);
  double sum = 0.0;
  for (double k = 0; k < most_ticks && std::abs(state[0]) + std::abs(state[1]) > 1e-9 * sum; ++k) {
    sum += std::abs(state[0]);
    state = (loop * state).eval();
  }
  return settings.device.resolution * felt.stiffness * sum;
}

std::int64_t ticks_to_decide(const LoopSettings& settings) {
  const double slowest =
      std::min(std::abs(growth_at(settings, 1.0 - band)), std::abs(growth_at(settings, 1.0 + band)));
  const double to_show = 2.0 * std::log(shown_by) / slowest;
  const double to_forget =
      2.0 * std::log(1e8) / std::abs(growth_at(settings, 0.0));  // the free device's start
  return static_cast<std::int64_t>(std::clamp(std::max(to_show, to_forget), least_ticks, most_ticks));
}

std::vector<Verdict> expected_verdicts(const LoopSettings& settings, std::int64_t ticks) {
  using enum Verdict;
  const double weaker = growth_at(settings, 1.0 - band), stronger = growth_at(settings, 1.0 + band);
  const double shown = 0.99 * 2.0 * std::log(shown_by) / static_cast<double>(ticks);
  if (std::max(weaker, stronger) < -shown) return {stable};
  if (std::min(weaker, stronger) < shown) return {stable, limit_cycle, diverged};
  if (std::holds_alternative<Wall>(settings.against)) return {diverged};
  // Yielding sand has a greatest force and takes energy. A device thrown off its rest swings, or comes to
  // rest where the sand has yielded.
  if (std::holds_alternative<YieldingSand>(settings.against)) return {stable, limit_cycle};
  if (settings.device.max_force > 0.0) return {limit_cycle};
  return {limit_cycle, diverged};
}

}  // namespace sandstroke
