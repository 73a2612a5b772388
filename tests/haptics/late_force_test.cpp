#include "haptics/late_force.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace sandstroke {
namespace {

DeviceSettings late(int delay, double dropped_ticks) {
  DeviceSettings settings;
  settings.delay = delay;
  settings.dropped_ticks = dropped_ticks;
  return settings;
}

/// The force computed in a tick: tells which tick it is from.
Eigen::Vector3d of_tick(int k) { return {k + 1.0, -2.0 * k, 3.0}; }

TEST(LateForce, ActsAtOnceByDefault) {
  LateForce force(late(0, 0.0));
  for (int k = 0; k < 10; ++k) EXPECT_EQ(force.act(of_tick(k)), of_tick(k));
}

TEST(LateForce, ActsAfterItsDelay) {
  for (const int delay : {1, 2, 20}) {
    LateForce force(late(delay, 0.0));
    for (int k = 0; k < 100; ++k)
      EXPECT_EQ(force.act(of_tick(k)), k < delay ? Eigen::Vector3d::Zero().eval() : of_tick(k - delay));
  }
}

TEST(LateForce, BeginsWithTheForceThatActsBefore) {
  const Eigen::Vector3d before(1.0, 2.0, 3.0);
  LateForce force(late(2, 0.0), before);
  EXPECT_EQ(force.act(of_tick(0)), before);
  EXPECT_EQ(force.act(of_tick(1)), before);
  EXPECT_EQ(force.act(of_tick(2)), of_tick(0));
}

TEST(LateForce, ALateFirstTickGivesOutWhatActedBefore) {
  const Eigen::Vector3d before(1.0, 2.0, 3.0);
  for (const int delay : {0, 2}) {
    LateForce force(late(delay, 0.999), before);
    for (int k = 0; k < 5 + delay; ++k) {
      if (k < 5) {
        ASSERT_TRUE(drops_tick(k, 0.999));
      }
      EXPECT_EQ(force.act(of_tick(k)), before) << k;
    }
  }
}

TEST(LateForce, ALateLoopGivesOutItsLastForceAgain) {
  for (const int delay : {0, 3}) {
    LateForce force(late(delay, 0.4));
    std::vector<Eigen::Vector3d> given_out;
    Eigen::Vector3d last = Eigen::Vector3d::Zero();
    for (int k = 0; k < 200; ++k) {
      if (!drops_tick(k, 0.4)) last = of_tick(k);
      given_out.push_back(last);
      const Eigen::Vector3d acts = force.act(of_tick(k));
      if (k < delay) continue;
      EXPECT_EQ(acts, given_out[static_cast<std::size_t>(k - delay)]);
    }
  }
}

TEST(DropsTick, DropsTheFractionAskedForWithoutAPattern) {
  constexpr int ticks = 200'000;
  for (const double fraction : {0.0, 0.01, 0.3, 0.9}) {
    const double deviation = std::sqrt(fraction * (1.0 - fraction) / ticks);  // of the mean of as many coins
    int dropped = 0, twice = 0;
    for (int k = 0; k < ticks; ++k) {
      dropped += drops_tick(k, fraction);
      twice += drops_tick(k, fraction) && drops_tick(k + 1, fraction);
    }
    EXPECT_NEAR(dropped / double{ticks}, fraction, 4.0 * deviation);
    EXPECT_NEAR(twice / double{ticks}, fraction * fraction, 8.0 * deviation);  // neighbours are independent
  }
}

TEST(DropsTick, FollowsSplitMix64sNumbers) {
  // The first five of seed 0, as published with the generator; the upper half is enough here.
  const double published[] = {0xe220a8397b1dcdafp-64, 0x6e789e6aa1b965f4p-64, 0x06c45d188009454fp-64,
                              0xf88bb8a8724c81ecp-64, 0x1b39896a51a8749bp-64};
  for (int k = 0; k < 5; ++k) {
    EXPECT_FALSE(drops_tick(k, published[k] * (1.0 - 1e-9))) << k;
    EXPECT_TRUE(drops_tick(k, published[k] * (1.0 + 1e-9))) << k;
  }
}

TEST(DropsTick, AHigherFractionDropsMoreTicksAndNoneLess) {
  for (int k = 0; k < 1000; ++k) EXPECT_LE(drops_tick(k, 0.2), drops_tick(k, 0.3));
}

}  // namespace
}  // namespace sandstroke
