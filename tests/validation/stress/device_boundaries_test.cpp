#include "validation/stress/device_parts.h"

#include <gtest/gtest.h>

#include "sanitized.h"
#include "validation/stress/loop_theory.h"

namespace sandstroke {
namespace {

TEST(DeviceBoundaries, MeasuredIsWhereTheEigenvalueLeavesTheUnitCircle) {
  for (const LoopSettings& loop : varied_loops(sanitized ? 4 : 60)) {
    const Boundary boundary = boundary_of(loop);
    EXPECT_NEAR(boundary.measured / boundary.exact, 1.0, 0.02) << boundary.settings;
    EXPECT_GT(boundary.measured, boundary.passive) << boundary.settings;
  }
}

TEST(DeviceBoundaries, EverythingThatIsPassiveIsStable) {
  for (const LoopSettings& loop : varied_loops(sanitized ? 100 : 2000)) {
    const LoopSettings passive = with_gain(loop, 0.999 * passive_gain(loop));
    EXPECT_GT(passivity_margin(passive), 0.0);
    EXPECT_LT(spectral_radius(passive), 1.0);
  }
}

TEST(DeviceBoundaries, PassiveIsStableWhateverTheFractionOfDrag) {
  for (const double fraction : {0.01, 1.0, 10.0, 100.0, 1000.0})  // B / (K T); the paper's under 3 N: 60
    for (LoopSettings loop : varied_loops(sanitized ? 20 : 400)) {
      loop.against = Wall{1.0, fraction / loop.device.servo_rate};
      EXPECT_LT(spectral_radius(with_gain(loop, 0.999 * passive_gain(loop))), 1.0)
          << fraction << ", delay " << loop.device.delay;
    }
}

}  // namespace
}  // namespace sandstroke
