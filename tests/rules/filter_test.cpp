#include "rules/filter.h"

#include <gtest/gtest.h>

namespace sandstroke {
namespace {

TEST(Filter, VanishesAtU0AndItsIntegralOverThePlaneAtU1) {
  EXPECT_NEAR(std::sin(filter::u0), filter::offset, 1e-15);
  // The integral over the plane, with u = rho^2 / s^2, is pi s^2 times that of sin(u) - 0.53 over u.
  EXPECT_NEAR(1.0 - std::cos(filter::u1), filter::offset * filter::u1, 1e-15);
}

TEST(Filter, IsNegativeUnderTheToolAndPositiveOnTheRing) {
  constexpr double radius = 0.01;
  EXPECT_NEAR(filter::u_of(radius * radius, radius), filter::u0, 1e-15);
  EXPECT_TRUE(filter::is_negative(filter::u_of(0.0099 * 0.0099, radius)));
  EXPECT_EQ(filter::positive(filter::u0), 0.0);
  EXPECT_NEAR(filter::positive(1.0), std::sin(1.0) - 0.53, 1e-15);
  EXPECT_NEAR(filter::u_of(filter::reach(radius) * filter::reach(radius), radius), filter::u1, 1e-15);
  EXPECT_EQ(filter::positive(1.2), 0.0);
}

TEST(Filter, UndersidesHaveTheSpheresCurvatureAtTheTip) {
  constexpr double radius = 0.01, rho = 1e-4;
  for (const ToolProfile profile : {ToolProfile::paper, ToolProfile::sphere})
    EXPECT_NEAR(filter::underside(profile, radius, rho * rho), rho * rho / (2.0 * radius), 1e-10);
  EXPECT_NEAR(filter::underside(ToolProfile::sphere, radius, 0.006 * 0.006), 0.002, 1e-15);
  EXPECT_NEAR(filter::underside(ToolProfile::paper, radius, radius * radius * (1 - 1e-12)),
              radius * 0.53 / (2.0 * filter::u0), 1e-9);
  EXPECT_TRUE(std::isinf(filter::underside(ToolProfile::sphere, radius, 1.01 * radius * radius)));
}

}  // namespace
}  // namespace sandstroke
