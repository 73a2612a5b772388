#include "haptics/passivity.h"

#include <gtest/gtest.h>

#include <limits>

namespace sandstroke {
namespace {

TEST(PassivityMargin, IsANumberOrMinusInfinityAtAnyDepth) {
  ForceSettings force;
  EXPECT_EQ(passivity_margin(1e4, repulse_force(1e4, force), force, {}),
            -std::numeric_limits<double>::infinity());
  force.k_f = 0.0;
  EXPECT_EQ(passivity_margin(1e4, repulse_force(1e4, force), force, {}),
            -std::numeric_limits<double>::infinity());
  force.k_s = 0.0;
  EXPECT_EQ(passivity_margin(1e4, repulse_force(1e4, force), force, {}), 9.0);
}

}  // namespace
}  // namespace sandstroke
