#include "sand/tool_path.h"

#include <gtest/gtest.h>

#include <cmath>

namespace sandstroke {
namespace {

const BedGeometry hall(100, 100, 0.002);  // 0.2 m
constexpr double tool_reach = 0.015, longest = 0.005, no_limit = 1e300;

TEST(ToolPath, GoesInEqualStepsOfTheLongestAtMost) {
  const Eigen::Vector3d from(-0.02, 0.003, -0.002), to(0.03, -0.01, -0.007);
  const TipSteps steps = steps_between(hall, tool_reach, from, to, longest, no_limit);
  EXPECT_EQ(steps.count, 11);  // 51.7 mm along the bed
  EXPECT_EQ(steps.at(0), from);
  for (int i = 0; i <= 11; ++i) EXPECT_LT((steps.at(i) - (from + i / 11.0 * (to - from))).norm(), 1e-17);
}

TEST(ToolPath, HasNoStepsInTheAirOrBesideTheBed) {
  EXPECT_EQ(steps_between(hall, tool_reach, {-0.05, 0.0, 0.001}, {0.05, 0.0, 0.001}, longest, 0.0).count, 0);
  EXPECT_EQ(steps_between(hall, tool_reach, {-5.0, 3.0, -0.01}, {5.0, 3.0, -0.01}, longest, 0.0).count, 0);
  // The part of a dive below the highest sand: a tenth of it.
  const TipSteps dive = steps_between(hall, tool_reach, {0.0, 0.0, 0.09}, {0.1, 0.0, -0.01}, longest, 0.0);
  EXPECT_NEAR(dive.begin.z(), 0.0, 1e-15);
  EXPECT_EQ(dive.count, 2);
}

TEST(ToolPath, CountsOnlyTheWayThroughSandFromBeyondAllMeasure) {
  for (const double far : {1.0, 1e6, 1e20, 1e300}) {
    const TipSteps steps =
        steps_between(hall, tool_reach, {-far, 0.0, -0.005}, {far, 0.0, -0.005}, longest, no_limit);
    EXPECT_LE(steps.count, 47) << far;
    EXPECT_LE(std::abs(steps.begin.x()), 0.116) << far;
  }
}

}  // namespace
}  // namespace sandstroke
