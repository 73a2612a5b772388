#include "validation/stress/device_parts.h"

#include <cmath>
#include <random>

#include "core/bisection.h"
#include "validation/stress/loop_margins.h"
#include "validation/stress/loop_theory.h"

namespace sandstroke {
std::vector<LoopSettings> varied_loops(int count) {
  std::mt19937 random(2006);
  const auto between = [&random](double low, double high) {  // equally many in every decade
    return low * std::pow(high / low, 0x1p-32 * static_cast<double>(random()));
  };
  std::vector<LoopSettings> loops;
  for (int i = 0; i < count; ++i) {
    LoopSettings& loop = loops.emplace_back();
    DeviceSettings& d = loop.device;
    d = ideal_device();
    d.servo_rate = between(50.0, 20e3);
    d.mass = between(0.02, 2.0);
    d.damping = between(0.1, 10.0);
    d.hand_stiffness = between(10.0, 3000.0);
    d.hand_damping = between(0.5, 30.0);
    d.scale = between(0.2, 5.0);
    d.delay = i % 2 ? static_cast<int>(random() % 21) : 0;
    const double drag =
        i % 3 ? 0.0 : between(1e-4, 0.3) / d.servo_rate;  // s, the drag B over the stiffness K
    if (i % 4 < 2) {
      loop.against = Wall{1.0, drag};
      loop.far = 1e3 * loop.disturbance;
    } else {
      PressedSand sand;
      sand.force.k_c = between(0.5, 500.0);
      sand.depth = between(0.1, 3.0) / sand.force.k_c;
      sand.force.k_s = 1.0;
      sand.force.drag = DragDirection::full;
      // B / K = k_f |F_r| / (k_s k_c exp(k_c d))
      sand.force.k_f = drag * sand.force.k_c / -std::expm1(-sand.force.k_c * sand.depth);
      loop.disturbance = 1e-7 * sand.depth / d.scale;  // so small that the law is linear about the rest
      loop.far = 1e4 * loop.disturbance;
      loop.against = sand;
    }
  }
  return loops;
}

double passive_gain(const LoopSettings& settings) {
  const double damping = settings.device.damping + settings.device.hand_damping;
  return damping / (damping - passivity_margin(settings));
}

namespace {

/// The gain at which a small disturbance starts to grow instead of dying out. Found to 0.1 % by bisection on
/// the simulated loop.
double measured_boundary_gain(const LoopSettings& settings) {
  constexpr std::int64_t ticks = 20'000;
  const auto settles = [&](double gain) { return run_loop(with_gain(settings, gain), ticks).growth < 1.0; };
  double low = passive_gain(settings);
  while (!settles(low)) low *= 0.5;
  double high = 2.0 * low;
  while (settles(high)) {
    low = high;
    high *= 2.0;
  }
  return boundary_between(low, high, 10, geometric_mean, settles);
}

}  // namespace

Boundary boundary_of(const LoopSettings& settings) {
  const double stiffness = felt_about_rest(settings).z.stiffness;  // at a gain of 1
  return {in_words(settings), stiffness * measured_boundary_gain(settings),
          stiffness * exact_boundary_gain(settings), stiffness * passive_gain(settings)};
}

}  // namespace sandstroke
