#include "stress/device_boundaries.h"

#include <gtest/gtest.h>

#include "stress/loop_theory.h"

namespace sandstroke {
namespace {

TEST(DeviceBoundaries, MeasuredIsWhereTheEigenvalueLeavesTheUnitCircle) {
  for (const LoopSettings& loop : varied_loops(60)) {
    const Boundary boundary = boundary_of(loop);
    EXPECT_NEAR(boundary.measured / boundary.exact, 1.0, 0.02) << boundary.settings;
    EXPECT_GT(boundary.measured, boundary.passive) << boundary.settings;
  }
}

TEST(DeviceBoundaries, EverythingThatIsPassiveIsStable) {
  for (const LoopSettings& loop : varied_loops(2000)) {
    const LoopSettings passive = with_gain(loop, 0.999 * passive_gain(loop));
    EXPECT_GT(passivity_margin(passive), 0.0);
    EXPECT_LT(spectral_radius(passive), 1.0);
  }
}

}  // namespace
}  // namespace sandstroke
