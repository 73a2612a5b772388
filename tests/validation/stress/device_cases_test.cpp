
#include <gtest/gtest.h>

#include <algorithm>

#include "haptics/passivity.h"
#include "sanitized.h"
#include "validation/stress/device_parts.h"
#include "validation/stress/loop_theory.h"
#include "validation/stress/stress.h"

namespace sandstroke {
namespace {

TEST(DeviceLoop, APassiveLoopReturnsNoMoreThanItsDampersTake) {
  // Along each axis the sand returns at most (K (T/2 + delay) + B) times the sum of (motion^2 / T), whatever
  // the motion; b + b_h of a passive loop is more. (Drag by the sampled velocity is not a difference of
  // positions, and has no such bound: none here.)
  for (const LoopSettings& varied : varied_loops(40)) {
    if (felt_about_rest(varied).z.damping > 0.0) continue;
    LoopSettings passive = with_gain(varied, 0.9 * passive_gain(varied));
    const auto* sand = std::get_if<PressedSand>(&passive.against);
    // An exponential law is stiffer below: no further than the tenth allows.
    passive.disturbance = sand ? 0.02 / (sand->force.k_c * passive.device.scale) : 1e-3;
    DeviceLoop loop(passive);
    const double damping = passive.device.damping + passive.device.hand_damping;
    const double start = loop.device().state().position.z();
    double returned = 0.0, motions = 0.0, most = 0.0, z = start;
    for (int k = 0; k < 5000; ++k) {
      loop.tick();
      const double after = loop.device().state().position.z();
      returned += loop.force().z() * (after - z);
      motions += (after - z) * (after - z) * passive.device.servo_rate;
      z = after;
      most = std::max(most, returned - damping * motions);
    }
    // The energy of the spring at the start may come back.
    const FeltAlong felt = felt_about_rest(passive);
    const double held = sand ? repulse_force(sand->depth, sand->force) * sand->depth / passive.device.scale
                             : 0.5 * felt.z.stiffness * start * start;
    EXPECT_LE(most, held * (1.0 + 1e-9)) << passive.device.servo_rate;
  }
}

TEST(StressDeviceLoop, FillsBoundariesMapsAndTraces) {
  if (sanitized) GTEST_SKIP() << "long; what it runs through, shorter tests do";
  StressReport report;
  StressOptions options;
  options.quick = true;
  stress_device_loop(report, options);
  EXPECT_GE(report.boundaries.size(), 50u);
  EXPECT_GE(report.maps.size(), 10u);
  for (const StressTrace& trace : report.traces)
    for (const auto& [name, values] : trace.series) EXPECT_EQ(values.size(), trace.time.size()) << name;
}

}  // namespace
}  // namespace sandstroke
