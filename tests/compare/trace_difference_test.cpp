#include "compare/trace_difference.h"

#include <gtest/gtest.h>

#include <cmath>

#include "synthetic_run.h"

namespace sandstroke {
namespace {

constexpr double no_number = std::numeric_limits<double>::quiet_NaN();

TEST(TraceDifference, IsZeroForEqualTracesWithALiftedTool) {
  const std::vector<TickRecord> trace = SyntheticRun().trace;
  ASSERT_TRUE(std::isnan(trace[0].level));
  const TraceDifference difference = trace_difference(trace, trace);
  EXPECT_EQ(difference.time.max, 0.0);
  EXPECT_EQ(difference.force.max, 0.0);
  EXPECT_EQ(difference.depth.max, 0.0);
  EXPECT_EQ(difference.level.max, 0.0);
}

TEST(TraceDifference, ForceIsTheLengthOfTheDifferenceAtItsTime) {
  const std::vector<TickRecord> golden = SyntheticRun().trace;
  std::vector<TickRecord> run = golden;
  run[50].device_force += Eigen::Vector3d(3.0, -4.0, 0.0);
  run[60].device_force += Eigen::Vector3d(0.0, 0.0, 2.0);
  run[70].depth -= 0.5;
  run[80].level += 0.25;
  const TraceDifference difference = trace_difference(golden, run);
  EXPECT_DOUBLE_EQ(difference.force.max, 5.0);
  EXPECT_EQ(difference.force.tick, 50u);
  EXPECT_DOUBLE_EQ(difference.force.time, 0.05);
  EXPECT_DOUBLE_EQ(difference.force.first, 0.05);
  EXPECT_DOUBLE_EQ(difference.depth.max, 0.5);
  EXPECT_EQ(difference.depth.tick, 70u);
  EXPECT_DOUBLE_EQ(difference.level.max, 0.25);
  EXPECT_EQ(difference.level.tick, 80u);
}

TEST(TraceDifference, KnowsWhereItBeginsToo) {
  const std::vector<TickRecord> golden = SyntheticRun().trace;
  std::vector<TickRecord> run = golden;
  run[40].depth += 1e-9;
  run[70].depth += 0.5;
  const ColumnDifference depth = trace_difference(golden, run).depth;
  EXPECT_EQ(depth.tick, 70u);
  EXPECT_DOUBLE_EQ(depth.first, golden[40].time);
}

TEST(TraceDifference, NanCountsWhereTheToolIsNotLiftedOrOnlyOneHasIt) {
  const std::vector<TickRecord> golden = SyntheticRun().trace;
  std::vector<TickRecord> run = golden;
  run[5].level = 0.0;  // golden: NaN
  EXPECT_TRUE(std::isnan(trace_difference(golden, run).level.max));
  EXPECT_EQ(trace_difference(golden, run).level.tick, 5u);

  run = golden;
  run[50].level = no_number;
  run[60].level += 100.0;
  EXPECT_TRUE(std::isnan(trace_difference(golden, run).level.max));
  EXPECT_EQ(trace_difference(golden, run).level.tick, 50u);
  EXPECT_TRUE(std::isnan(trace_difference(run, run).level.max)) << "in contact, NaN is never right";

  run = golden;
  run[3].device_force.y() = no_number;
  run[4].depth = no_number;
  EXPECT_TRUE(std::isnan(trace_difference(run, run).force.max)) << "a force is never NaN, not even lifted";
  EXPECT_TRUE(std::isnan(trace_difference(run, run).depth.max)) << "nor is a depth";
}

TEST(TraceDifference, ComparesTheTicksThatBothHave) {
  const std::vector<TickRecord> golden = SyntheticRun().trace;
  std::vector<TickRecord> run = golden;
  run[104].device_force.z() += 1.0;
  run.pop_back();
  EXPECT_EQ(trace_difference(golden, run).force.max, 0.0);
}

TEST(TraceDifference, ALevelMayOnlyBeMissingWhereBothAreLifted) {
  const std::vector<TickRecord> golden = SyntheticRun().trace;
  for (const auto& [golden_touches, run_touches] : {std::pair{true, false}, {false, true}, {true, true}}) {
    std::vector<TickRecord> a = golden, b = golden;  // lifted in tick 7
    a[7].contact = golden_touches;
    b[7].contact = run_touches;
    EXPECT_TRUE(std::isnan(trace_difference(a, b).level.max));
    EXPECT_EQ(trace_difference(a, b).level.tick, 7u);
  }
}

TEST(TraceDifference, TheTimeIsGoldensOfTheTickThatDiffersMost) {
  const std::vector<TickRecord> golden = SyntheticRun().trace;
  std::vector<TickRecord> run = golden;
  run[30].time += 0.25;
  run[40].depth -= 0.5;
  run[40].time -= 0.5;
  const TraceDifference difference = trace_difference(golden, run);
  EXPECT_DOUBLE_EQ(difference.time.max, 0.5);
  EXPECT_EQ(difference.time.tick, 40u);
  EXPECT_EQ(difference.depth.time, golden[40].time);
}

}  // namespace
}  // namespace sandstroke
