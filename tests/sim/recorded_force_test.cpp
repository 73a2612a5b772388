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

}  // namespace
}  // namespace sandstroke
