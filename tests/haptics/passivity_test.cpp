#include "haptics/passivity.h"

#include <gtest/gtest.h>

#include <limits>

#include "rules/force.h"

namespace sandstroke {
namespace {

double margin_at(double depth, const ForceSettings& force) {
  const FeltSand sand = felt_sand(depth, repulse_force(depth, force), 1.0, force);
  return passivity_margin(sand.stiffness, sand.drag, {});
}

TEST(PassivityMargin, IsANumberOrMinusInfinityAtAnyDepth) {
  ForceSettings force;
  EXPECT_EQ(margin_at(1e4, force), -std::numeric_limits<double>::infinity());
  force.k_f = 0.0;
  EXPECT_EQ(margin_at(1e4, force), -std::numeric_limits<double>::infinity());
  force.k_s = 0.0;
  EXPECT_EQ(margin_at(1e4, force), 9.0);
}

}  // namespace
}  // namespace sandstroke
