#include "compare/trace_difference.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"
#include "synthetic_run.h"

namespace sandstroke {
namespace {

constexpr double no_number = std::numeric_limits<double>::quiet_NaN();

TEST(TraceDifference, IsZeroForEqualTracesWithALiftedTool) {
  const RunTrace trace = SyntheticRun().trace;
  ASSERT_TRUE(std::isnan(trace.level[0]));
  const TraceDifference difference = trace_difference(trace, trace);
  EXPECT_EQ(difference.time.max, 0.0);
  EXPECT_EQ(difference.force.max, 0.0);
  EXPECT_EQ(difference.depth.max, 0.0);
  EXPECT_EQ(difference.level.max, 0.0);
}

TEST(TraceDifference, ForceIsTheLengthOfTheDifferenceAtItsTime) {
  const RunTrace golden = SyntheticRun().trace;
  RunTrace run = golden;
  run.device_force[50] += Eigen::Vector3d(3.0, -4.0, 0.0);
  run.device_force[60] += Eigen::Vector3d(0.0, 0.0, 2.0);
  run.depth[70] -= 0.5;
  run.level[80] += 0.25;
  const TraceDifference difference = trace_difference(golden, run);
  EXPECT_DOUBLE_EQ(difference.force.max, 5.0);
  EXPECT_EQ(difference.force.tick, 50u);
  EXPECT_DOUBLE_EQ(difference.force.time, 0.05);
  EXPECT_DOUBLE_EQ(difference.depth.max, 0.5);
  EXPECT_EQ(difference.depth.tick, 70u);
  EXPECT_DOUBLE_EQ(difference.level.max, 0.25);
  EXPECT_EQ(difference.level.tick, 80u);
}

TEST(TraceDifference, NanCountsWhereTheToolIsNotLiftedOrOnlyOneHasIt) {
  const RunTrace golden = SyntheticRun().trace;
  RunTrace run = golden;
  run.level[5] = 0.0;  // golden: NaN
  EXPECT_TRUE(std::isnan(trace_difference(golden, run).level.max));
  EXPECT_EQ(trace_difference(golden, run).level.tick, 5u);

  run = golden;
  run.level[50] = no_number;
  run.level[60] += 100.0;
  EXPECT_TRUE(std::isnan(trace_difference(golden, run).level.max));
  EXPECT_EQ(trace_difference(golden, run).level.tick, 50u);
  EXPECT_TRUE(std::isnan(trace_difference(run, run).level.max)) << "in contact, NaN is never right";

  run = golden;
  run.device_force[3].y() = no_number;
  run.depth[4] = no_number;
  EXPECT_TRUE(std::isnan(trace_difference(run, run).force.max)) << "a force is never NaN, not even lifted";
  EXPECT_TRUE(std::isnan(trace_difference(run, run).depth.max)) << "nor is a depth";
}

TEST(TraceDifference, ComparesTheTicksThatBothHave) {
  const RunTrace golden = SyntheticRun().trace;
  RunTrace run = golden;
  run.device_force[104].z() += 1.0;
  run.time.pop_back();
  run.level.pop_back();
  run.depth.pop_back();
  run.contact.pop_back();
  run.device_force.pop_back();
  EXPECT_EQ(trace_difference(golden, run).force.max, 0.0);
}

TEST(TraceDifference, NamesTheColumnThatIsMissing) {
  const RunTrace golden = SyntheticRun().trace;
  RunTrace run = golden;
  run.depth.clear();
  try {
    trace_difference(golden, run);
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("'depth'"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace sandstroke
