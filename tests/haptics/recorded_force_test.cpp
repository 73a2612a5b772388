#include "haptics/recorded_force.h"

#include <gtest/gtest.h>

#include <cmath>

#include "haptics/recording.h"

namespace sandstroke {
namespace {

/// A stroke recorded at 0, 1, 2 and 3 s, with forces 0, 2, 4 and 6 N upward.
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

/// The force along z; NaN if it is not known.
double recorded_at(RecordedForce& recorded, double time) { return recorded.at(time).z(); }

TEST(RecordedForce, IsLinearBetweenSamples) {
  const Stroke stroke = rising();
  RecordedForce recorded(stroke);
  for (const auto& [time, force] : {std::pair{0.0, 0.0}, {1.25, 2.5}, {2.5, 5.0}, {3.0, 6.0}})
    EXPECT_EQ(recorded_at(recorded, time), force);
  Stroke uneven = rising();
  uneven.time = {5.0, 5.25, 7.25, 7.5};  // ticks begin at 0
  RecordedForce late(uneven);
  for (const auto& [time, force] :
       {std::pair{0.0, 0.0}, {0.125, 1.0}, {0.25, 2.0}, {0.75, 2.5}, {1.75, 3.5}, {2.25, 4.0}, {2.375, 5.0}})
    EXPECT_NEAR(recorded_at(late, time), force, 1e-14);
}

TEST(RecordedForce, OfTheHandOnTheDeviceIsTurnedRound) {
  Stroke stroke = rising();
  stroke.force_sign = ForceSign::by_hand;
  RecordedForce recorded(stroke);
  EXPECT_EQ(recorded_at(recorded, 1.0), -2.0);
  EXPECT_EQ(recorded_at(recorded, 1.25), -2.5);
}

TEST(RecordedForce, IsNotKnownWhereTheRecorderAlteredItOrNothingWasRecorded) {
  Stroke stroke = rising();
  stroke.flags = {late_sample, 0, 0, ramped_force};
  RecordedForce altered(stroke);
  EXPECT_EQ(recorded_at(altered, 0.0), 0.0);
  EXPECT_EQ(recorded_at(altered, 2.0), 4.0);
  EXPECT_TRUE(std::isnan(recorded_at(altered, 2.5)));
  EXPECT_TRUE(std::isnan(recorded_at(altered, 3.0)));
  stroke.gap_threshold = 0.5;
  RecordedForce across_gaps(stroke);
  EXPECT_TRUE(std::isnan(recorded_at(across_gaps, 0.5)));
  EXPECT_EQ(recorded_at(across_gaps, 1.0), 2.0);
  stroke.force.clear();
  EXPECT_TRUE(std::isnan(RecordedForce(stroke).at(1.0).z()));
}

TEST(RecordedForce, OnlyFlagsThatSayTheForceWasAlteredLeaveASampleOut) {
  for (const auto& [flag, known] : {std::pair{late_sample, true},
                                    {after_skipped_ticks, true},
                                    {clamped_force, false},
                                    {ramped_force, false},
                                    {rate_limited_force, false},
                                    {refused_force, false},
                                    {deferred_sand, false},
                                    {interlocked_force, false},
                                    {unfelt_force, false}}) {
    Stroke stroke = rising();
    stroke.flags = {0, flag, 0, 0};
    RecordedForce recorded(stroke);
    EXPECT_EQ(!std::isnan(recorded_at(recorded, 1.0)), known) << flag;
  }
}

}  // namespace
}  // namespace sandstroke
