#include "haptics/swing_watch.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace sandstroke {
namespace {

/// A swing at 5 Hz for this many periods along an axis, at 1 kHz. Its energy falls by `loss` a period; the
/// sand returns the fraction `returned` of its kinetic energy in each.
struct Swing {
  int axis = 2, periods = 40;
  double loss = 0.0, returned = 0.5, hand = 0.0, stored = 1e-3;
};

bool swings(const Swing& swing) {
  constexpr double mass = 0.25, speed = 0.3;
  SwingWatch watch;
  for (int k = 0; k < 200 * swing.periods; ++k) {
    const double periods = k / 200.0, energy = std::pow(1.0 - swing.loss, periods);
    const double velocity = speed * std::sqrt(energy) * std::sin(2.0 * std::numbers::pi * periods - 0.1);
    const double returned = swing.returned * 0.5 * mass * speed * speed * energy / 200.0;
    const Eigen::Vector3d along = Eigen::Vector3d::Unit(swing.axis);
    if (watch.add(velocity * along, swing.hand * along, returned * along, swing.stored, mass)) return true;
  }
  return false;
}

TEST(SwingWatch, FindsASwingThatTheSandKeepsUp) {
  for (const int axis : {0, 1, 2}) EXPECT_TRUE(swings({.axis = axis}));
  EXPECT_TRUE(swings({.loss = -0.02}));
  EXPECT_TRUE(swings({.hand = 0.149}));
}

TEST(SwingWatch, LeavesAloneWhatSettlesWhatTheHandDoesAndWhatTheSandHadStored) {
  EXPECT_FALSE(swings({.loss = 0.05}));
  EXPECT_FALSE(swings({.returned = -0.5}));
  EXPECT_FALSE(swings({.hand = 0.151}));
  EXPECT_FALSE(swings({.periods = 18})) << "not yet ten times its energy";
  EXPECT_FALSE(swings({.stored = 1.0}));
}

}  // namespace
}  // namespace sandstroke
