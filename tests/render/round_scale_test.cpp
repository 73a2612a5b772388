#include "render/round_scale.h"

#include <gtest/gtest.h>

#include <cmath>

namespace sandstroke {
namespace {

TEST(RoundScale, IntervalsAreOneTwoOrFiveTimesAPowerOfTen) {
  EXPECT_DOUBLE_EQ(round_interval(1.0, 10), 0.1);
  EXPECT_DOUBLE_EQ(round_interval(0.3, 3), 0.1);
  EXPECT_DOUBLE_EQ(round_interval(1.0, 7), 0.2);
  EXPECT_DOUBLE_EQ(round_interval(3.1, 7), 0.5);
  EXPECT_DOUBLE_EQ(round_interval(6e-6, 10), 1e-6);
  EXPECT_DOUBLE_EQ(round_interval(9.0, 1), 10.0);
}

TEST(RoundScale, IntervalsFitAsOftenAsAllowedAndNotFarLess) {
  for (double range = 1e-7; range < 1e4; range *= 1.37) {
    const double count = range / round_interval(range, 14);
    EXPECT_LE(count, 14.0 + 1e-6) << range;
    EXPECT_GE(count, 14.0 / 2.5 - 1e-6) << range;
  }
}

TEST(RoundScale, UnitsKeepNumbersShort) {
  EXPECT_EQ(length_unit(2.0).name, "m");
  EXPECT_EQ(length_unit(0.05).name, "mm");
  EXPECT_EQ(length_unit(5e-4).name, "um");
  EXPECT_EQ(length_unit(5e-8).name, "nm");
}

TEST(RoundScale, TicksAreRoundNumbersInsideTheScale) {
  // 21.1 mm in at most 7 steps: every 5 mm.
  const auto ticks = scale_ticks(-0.0062, 0.0149, length_unit(0.0149), 7);
  ASSERT_EQ(ticks.size(), 4u);
  EXPECT_EQ(ticks[0].label, "-5");
  EXPECT_EQ(ticks[1].label, "0");
  EXPECT_EQ(ticks[2].label, "5");
  EXPECT_EQ(ticks[3].label, "10");
  EXPECT_DOUBLE_EQ(ticks[3].value, 0.010);
}

TEST(RoundScale, ZeroHasNoSign) {
  const auto ticks = scale_ticks(-0.01, 0.01, length_unit(0.01), 4);
  ASSERT_EQ(ticks.size(), 5u);
  EXPECT_EQ(ticks[2].label, "0");
  EXPECT_EQ(ticks[2].value, 0.0);
  EXPECT_EQ(ticks[4].label, "10");
  EXPECT_DOUBLE_EQ(ticks[4].value, 0.01);
}

TEST(RoundScale, LabelsHaveTheDecimalsOfTheInterval) {
  const auto ticks = scale_ticks(0.0, 0.001, length_unit(0.001), 5);
  ASSERT_EQ(ticks.size(), 6u);
  EXPECT_EQ(ticks[1].label, "0.2");
  EXPECT_EQ(ticks[5].label, "1.0");
}

}  // namespace
}  // namespace sandstroke
