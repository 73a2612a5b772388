#include "sim/recorded_force.h"

#include <gtest/gtest.h>

#include "haptics/recording.h"

namespace sandstroke {
namespace {

/// Recorded at 0, 1, 2 and 3 s, with forces 0, 2, 4 and 6 N upward.
Stroke rising() {
  Stroke stroke;
  stroke.gap_threshold = 10.0;
  for (int i = 0; i < 4; ++i) {
    stroke.time.push_back(i);
    stroke.position.emplace_back(0.0, 0.0, 0.0);
    stroke.force.emplace_back(0.0, 0.0, 2.0 * i);
  }
  return stroke;
}

TickRecord tick(double time, const Eigen::Vector3d& force) {
  TickRecord record;
  record.time = time;
  record.device_force = force;
  return record;
}

TEST(RecordedForce, IsHeldAgainstTheRunBetweenSamples) {
  const Stroke stroke = rising();
  RecordedForce recorded(stroke);
  recorded.on_tick(tick(0.0, {0.0, 0.0, 0.0}));
  recorded.on_tick(tick(1.25, {0.0, 0.0, 2.5}));
  EXPECT_EQ(recorded.difference().max, 0.0);
  recorded.on_tick(tick(2.5, {3.0, 0.0, 1.0}));  // 5 N felt
  recorded.on_tick(tick(3.0, {0.0, 0.0, 6.0}));
  EXPECT_EQ(recorded.difference().ticks, 4);
  EXPECT_DOUBLE_EQ(recorded.difference().max, 5.0);
  EXPECT_DOUBLE_EQ(recorded.difference().rms, 2.5);
}

TEST(RecordedForce, IsNotComparedWhereTheRecorderAlteredItOrNothingWasRecorded) {
  Stroke stroke = rising();
  stroke.flags = {late_sample, 0, 0, ramped_force};
  stroke.gap_threshold = 0.5;
  RecordedForce across_gaps(stroke);
  across_gaps.on_tick(tick(0.5, {9.0, 0.0, 0.0}));
  EXPECT_EQ(across_gaps.difference().ticks, 0);
  across_gaps.on_tick(tick(1.0, {0.0, 0.0, 2.0}));
  EXPECT_EQ(across_gaps.difference().ticks, 1);
  stroke.gap_threshold = 10.0;
  RecordedForce altered(stroke);
  altered.on_tick(tick(0.0, {0.0, 0.0, 0.0}));
  altered.on_tick(tick(2.5, {9.0, 0.0, 0.0}));
  altered.on_tick(tick(3.0, {9.0, 0.0, 0.0}));
  EXPECT_EQ(altered.difference().ticks, 1);
  EXPECT_EQ(altered.difference().max, 0.0);
}

TEST(RecordedForce, IsLinearBetweenSamplesThatAreUnevenAndBeginLate) {
  Stroke stroke = rising();
  stroke.time = {5.0, 5.25, 7.25, 7.5};  // ticks begin at 0
  RecordedForce recorded(stroke);
  for (const auto& [time, force] :
       {std::pair{0.0, 0.0}, {0.125, 1.0}, {0.25, 2.0}, {0.75, 2.5}, {1.75, 3.5}, {2.25, 4.0}, {2.375, 5.0}})
    recorded.on_tick(tick(time, {0.0, 0.0, force}));
  EXPECT_EQ(recorded.difference().ticks, 7);
  EXPECT_LT(recorded.difference().max, 1e-14);
}

TEST(RecordedForce, OnlyFlagsThatSayTheForceWasAlteredLeaveASampleOut) {
  for (const auto& [flag, compared] : {std::pair{late_sample, true},
                                       {after_skipped_ticks, true},
                                       {clamped_force, false},
                                       {ramped_force, false},
                                       {rate_limited_force, false},
                                       {refused_force, false},
                                       {held_sand, false},
                                       {interlocked_force, false}}) {
    Stroke stroke = rising();
    stroke.flags = {0, flag, 0, 0};
    RecordedForce recorded(stroke);
    recorded.on_tick(tick(1.0, {0.0, 0.0, 2.0}));
    EXPECT_EQ(recorded.difference().ticks, compared ? 1 : 0) << flag;
  }
}

}  // namespace
}  // namespace sandstroke
