#include "record/force_guard.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "haptics/recording.h"

namespace sandstroke {
namespace {

using Eigen::Vector3d;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double largest = std::numeric_limits<double>::max();

ForceLimits limits(double max_force, double ramp, double rate) { return {max_force, ramp, rate, 0.0}; }

/// A guard whose interlock has been open for so many seconds, at time 10 s.
ForceGuard open_for(double seconds, const ForceLimits& limits, double servo_rate = 1000.0) {
  ForceGuard guard(limits, servo_rate);
  const int readings = static_cast<int>(seconds / 0.02) + 1;
  for (int i = readings; i >= 0; --i) guard.interlock().see(10.0 - seconds * i / readings, 0.0);
  return guard;
}

TEST(ForceGuard, LetsThroughWhatKeepsToAllLimits) {
  ForceGuard guard = open_for(0.5, limits(5.0, 0.5, 1000.0));
  const FeltForce given = guard.admit(10.0, {{1.0, 2.0, 3.0}, deferred_sand}, {1.0, 2.0, 2.5});
  EXPECT_EQ(given.force, Vector3d(1.0, 2.0, 3.0));
  EXPECT_EQ(given.flags, deferred_sand);
}

TEST(ForceGuard, RefusesWhatIsNoNumberAtOnce) {
  for (const double bad : {nan, infinity, -infinity}) {
    for (int axis = 0; axis < 3; ++axis) {
      ForceGuard guard = open_for(0.0, limits(5.0, 0.0, 1000.0));
      Vector3d wanted(1.0, 1.0, 1.0);
      wanted[axis] = bad;
      const FeltForce given = guard.admit(10.0, {wanted, deferred_sand}, {0.0, 0.0, 5.0});
      EXPECT_EQ(given.force, Vector3d::Zero());
      EXPECT_EQ(given.flags, deferred_sand | refused_force);
      EXPECT_FALSE(guard.interlock().is_open());
    }
  }
}

TEST(ForceGuard, FadesInLinearly) {
  const ForceLimits slow = limits(100.0, 2.0, infinity);
  for (const double time : {0.0, 0.5, 1.0, 1.5}) {
    ForceGuard guard = open_for(time, slow);
    const FeltForce given = guard.admit(10.0, {{0.0, 0.0, 8.0}}, Vector3d::Zero());
    EXPECT_EQ(given.force, Vector3d(0.0, 0.0, 4.0 * time));
    EXPECT_EQ(given.flags, ramped_force);
  }
  EXPECT_EQ(open_for(2.0, slow).admit(10.0, {{0.0, 0.0, 8.0}}, Vector3d::Zero()).flags, 0u);
  EXPECT_EQ(open_for(0.0, slow).admit(10.0, {}, Vector3d::Zero()).flags, 0u)
      << "nothing fades where there is no force";
}

TEST(ForceGuard, CutsTheMagnitudeAndKeepsTheDirection) {
  ForceGuard guard = open_for(0.0, limits(5.0, 0.0, infinity));
  for (const double size : {6.0, 1e3, 1e200, largest}) {
    const FeltForce given = guard.admit(10.0, {Vector3d(0.0, 0.6, -0.8) * size}, Vector3d::Zero());
    EXPECT_NEAR((given.force - Vector3d(0.0, 3.0, -4.0)).norm(), 0.0, 1e-14);
    EXPECT_EQ(given.flags, clamped_force);
  }
  const FeltForce given = guard.admit(10.0, {Vector3d::Constant(largest)}, Vector3d::Zero());
  EXPECT_NEAR(given.force.norm(), 5.0, 1e-14) << "though its norm is beyond all numbers";
}

TEST(ForceGuard, ItsLimitsAreWhereTheyAreSet) {
  const Vector3d direction = Vector3d(2.0, -3.0, 6.0) / 7.0;
  for (const double ratio : {0.95, 1.05}) {
    const auto flags_of = [&](const ForceLimits& set, double time, double size, double held) {
      return open_for(time, set).admit(10.0, {size * direction}, held * direction).flags;
    };
    EXPECT_EQ(flags_of(limits(5.0, 0.0, infinity), 1.0, ratio * 5.0, 0.0), ratio > 1.0 ? clamped_force : 0u);
    // 2 N per tick, up or down
    EXPECT_EQ(flags_of(limits(9.0, 0.0, 2000.0), 1.0, 1.0 + ratio * 2.0, 1.0),
              ratio > 1.0 ? rate_limited_force : 0u);
    EXPECT_EQ(flags_of(limits(9.0, 0.0, 2000.0), 1.0, 4.0 - ratio * 2.0, 4.0),
              ratio > 1.0 ? rate_limited_force : 0u);
    EXPECT_EQ(flags_of(limits(9.0, 0.5, infinity), ratio * 0.5, 1.0, 0.0), ratio < 1.0 ? ramped_force : 0u);
  }
}

TEST(ForceGuard, GivesNoneAtAllWhereTheLimitIsZero) {
  ForceGuard guard = open_for(0.0, limits(0.0, 0.0, infinity));
  for (const double size : {1e-300, 1.0, largest}) {
    const FeltForce given = guard.admit(10.0, {{0.0, size, 0.0}}, Vector3d::Zero());
    EXPECT_EQ(given.force, Vector3d::Zero());
    EXPECT_EQ(given.flags, 0u);  // nothing is cut of a force that is not given
  }
}

TEST(ForceGuard, ApproachesAForceThatJumpsByTheRatePerTick) {
  ForceGuard guard = open_for(0.0, limits(12.0, 0.0, 1000.0), 500.0);  // 2 N per tick
  Vector3d held = Vector3d::Zero();
  for (int tick = 1; tick <= 5; ++tick) {
    const FeltForce given = guard.admit(10.0 + 2e-3 * tick, {{0.0, 0.0, 9.0}}, held);
    held = given.force;
    EXPECT_NEAR(held.z(), std::min(2.0 * tick, 9.0), 1e-14);
    EXPECT_EQ(given.flags, tick < 5 ? rate_limited_force : 0u);
  }
}

TEST(ForceGuard, KeepsItsPromiseForAnyForces) {
  std::mt19937_64 random(6);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> exponent(-5.0, 5.0), uniform;
  for (int series = 0; series < 200; ++series) {
    const double max_force = std::pow(10.0, exponent(random)), rate = std::pow(10.0, exponent(random) + 3.0);
    const double ramp = uniform(random), step = rate / 1000.0;
    ForceGuard guard = open_for(0.0, limits(max_force, ramp, rate));
    Vector3d held = Vector3d::Zero();
    double time = 10.0, opened = 10.0;
    for (int tick = 0; tick < 500; ++tick) {
      time += 0.01 * uniform(random);
      Vector3d wanted(normal(random), normal(random), normal(random));
      wanted *= max_force * std::pow(10.0, exponent(random));
      if (uniform(random) < 0.02) wanted[tick % 3] = tick % 2 == 0 ? nan : infinity;
      if (uniform(random) < 0.02) wanted[tick % 3] = largest;
      const FeltForce given = guard.admit(time, {wanted}, held);
      if (!guard.interlock().is_open()) {  // after a refused force
        ASSERT_EQ(given.force, Vector3d::Zero());
        ASSERT_NE(given.flags & (refused_force | interlocked_force), 0u);
        guard.interlock().see(time, 0.0);
        opened = time;
        held = given.force;
        continue;
      }
      ASSERT_TRUE(given.force.allFinite());
      ASSERT_LE(given.force.norm(), max_force * (1.0 + 1e-14));
      ASSERT_LE((given.force - held).norm(), step + 1e-15 * max_force);
      if (given.flags == 0) {
        ASSERT_EQ(given.force, wanted);
      }
      ASSERT_EQ((given.flags & ramped_force) != 0, time - opened < ramp);
      held = given.force;
    }
  }
}

TEST(ForceGuard, EachLimitBeginsWhereItSays) {
  const ForceLimits each = limits(5.0, 2.0, 1500.0);
  const auto guard_at = [&](double seconds) { return open_for(seconds, each, 500.0); };  // 3 N per tick
  const Vector3d along(0.48, -0.64, 0.6);
  for (const double ratio : {0.95, 1.05}) {
    const bool over = ratio > 1.0;
    const FeltForce large = guard_at(3.0).admit(10.0, {5.0 * ratio * along}, 4.0 * along);
    EXPECT_EQ(large.flags, over ? clamped_force : 0u);
    EXPECT_NEAR(large.force.norm(), over ? 5.0 : 4.75, 1e-14);
    const FeltForce jumping = guard_at(3.0).admit(10.0, {3.0 * ratio * along}, Vector3d::Zero());
    EXPECT_EQ(jumping.flags, over ? rate_limited_force : 0u);
    EXPECT_NEAR(jumping.force.norm(), over ? 3.0 : 2.85, 1e-14);
    const FeltForce early = guard_at(2.0 * ratio).admit(10.0, {along}, Vector3d::Zero());
    EXPECT_EQ(early.flags, over ? 0u : ramped_force);
    EXPECT_NEAR(early.force.norm(), over ? 1.0 : 0.95, 1e-14);
  }
}

TEST(ForceGuard, FadesInThenCutsThenHoldsBack) {
  ForceGuard guard = open_for(1.0, limits(5.0, 2.0, 1000.0));
  // 8 N at half of the ramp are 4 N: not cut; 16 N are 8 N: cut to 5 N; both 1 N at most from what is held.
  const FeltForce faded = guard.admit(10.0, {{8.0, 0.0, 0.0}}, {3.5, 0.0, 0.0});
  EXPECT_EQ(faded.flags, ramped_force);
  EXPECT_NEAR(faded.force.x(), 4.0, 1e-14);
  const FeltForce cut = guard.admit(10.0, {{16.0, 0.0, 0.0}}, {4.5, 0.0, 0.0});
  EXPECT_EQ(cut.flags, ramped_force | clamped_force);
  EXPECT_NEAR(cut.force.x(), 5.0, 1e-14);
  const FeltForce held_back = guard.admit(10.0, {{16.0, 0.0, 0.0}}, {-1.0, 0.0, 0.0});
  EXPECT_EQ(held_back.flags, ramped_force | clamped_force | rate_limited_force);
  EXPECT_NEAR(held_back.force.x(), 0.0, 1e-14);
}

TEST(ForceGuard, GivesNoneToAHandThatComesFromBesideTheSand) {
  ForceGuard guard(limits(12.0, 1.0, 1000.0), 1000.0);
  FeltForce beside;
  beside.is_above_or_in_sand = false;
  double time = 0.0;
  for (; time < 2.0; time += 1e-3) guard.admit(time, beside, Vector3d::Zero());
  const FeltForce deep{{0.0, 0.0, 12.0}};
  for (; time < 3.0; time += 1e-3) {
    const FeltForce given = guard.admit(time, deep, Vector3d::Zero());
    ASSERT_EQ(given.force, Vector3d::Zero());
    ASSERT_EQ(given.flags, interlocked_force);
  }
  guard.admit(time, {}, Vector3d::Zero());  // out of the sand
  EXPECT_TRUE(guard.interlock().is_open());
}

TEST(ForceGuard, GivesNoneToAHandThatRestsWhereAForceIsDue) {
  ForceGuard guard(limits(5.0, 0.0, 1e6), 1000.0);
  FeltForce resting;
  resting.due = 0.21;
  for (int i = 0; i < 1000; ++i) guard.admit(1e-3 * i, resting, Vector3d::Zero());
  EXPECT_FALSE(guard.interlock().is_open());
  const FeltForce given = guard.admit(1.0, {{0.0, 0.0, 3.0}}, Vector3d::Zero());
  EXPECT_EQ(given.force, Vector3d::Zero());
  EXPECT_TRUE(given.flags & interlocked_force);
  resting.due = 0.19;  // out of the sand, nearly
  for (int i = 0; i < 100; ++i) guard.admit(1.001 + 1e-3 * i, resting, Vector3d::Zero());
  EXPECT_TRUE(guard.interlock().is_open());
}

TEST(ForceGuard, ALimitBelowZeroIsNone) {
  ForceGuard guard = open_for(0.0, limits(-3.0, 0.0, infinity));
  EXPECT_EQ(guard.admit(10.0, {{0.0, 2.0, 0.0}}, Vector3d::Zero()).force, Vector3d::Zero());
}

TEST(ForceGuard, GivesNoneBeforeTheToolWasOutOfTheSand) {
  ForceGuard guard({5.0, 0.5, infinity}, 1000.0);
  double time = 0.0;
  const auto admit = [&](double force) {
    time += 1e-3;
    return guard.admit(time, {{0.0, 0.0, force}, deferred_sand}, Vector3d::Zero());
  };
  for (int tick = 0; tick < 2000; ++tick) {  // longer than the fade-in
    const FeltForce given = admit(12.0);
    ASSERT_EQ(given.force, Vector3d::Zero());
    ASSERT_EQ(given.flags, deferred_sand | interlocked_force);
  }
  while (!guard.interlock().is_open()) ASSERT_EQ(admit(0.0).flags, deferred_sand) << "nothing is withheld";
  const double opened = time;
  for (int tick = 0; tick < 400; ++tick) {  // and fades in from then
    const FeltForce given = admit(4.0);
    ASSERT_EQ(given.flags, deferred_sand | ramped_force);
    ASSERT_NEAR(given.force.z(), 4.0 * (time - opened) / 0.5, 1e-9);
  }
}

}  // namespace
}  // namespace sandstroke
