#include "sim/sand_side.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace sandstroke {
namespace {

const std::function<void()> no_slip = [] {};

TEST(SandSide, AFastTickDisplacesAsTicksInBetweenWould) {
  const Eigen::Vector3d from(-0.02, 0.003, -0.002), to(0.03, -0.01, -0.007);
  const ToolSettings tool{0.01, ToolProfile::sphere};
  const DisplacementSettings ahead{Deposit::ahead};
  HeightField one(100, 100, 0.002), many = one;
  SandSide fast(tool, ahead, 0.0);
  fast.move(one, from, from, no_slip);
  const double volume = fast.move(one, to, to, no_slip).displaced_volume;

  const int steps = 11;  // 51.7 mm along the bed in steps of half a radius at most
  ToolFootprint footprint(tool);
  double expected = 0.0;
  for (int i = 0; i <= steps; ++i) {
    const Eigen::Vector3d tip = i == steps ? to : Eigen::Vector3d(from + i / double{steps} * (to - from));
    footprint.place(many, tip.x(), tip.y());
    const Eigen::Vector3d motion = i == 0 ? Eigen::Vector3d::Zero() : Eigen::Vector3d(to - from);
    const double moved = displace(many, footprint, tip.z(), motion, ahead);
    if (i > 0) expected += moved;
  }
  EXPECT_GT(expected, 0.0);
  EXPECT_NEAR(volume, expected, 1e-12 * expected);
  EXPECT_LT((one.grid() - many.grid()).abs().maxCoeff(), 1e-15);  // places by one rounding apart
}

/// Where sand slips along a drag of 40 mm in ticks of this length [m].
std::vector<double> slips_of_a_drag(double tick) {
  HeightField bed(100, 100, 0.002);
  SandSide sand({0.01, ToolProfile::sphere, true}, {Deposit::outward}, 0.004);
  std::vector<double> slips;
  Eigen::Vector3d tip(-0.02, 0.0, -0.003);
  const auto slip = [&] {
    sand.hold(bed);
    // Held are the cells under the tool where it is now: their middle.
    double sum = 0.0, cells = 0.0;
    for (int col = 0; col < 100; ++col)
      if (bed.is_held(50, col)) sum += bed.x_of(col), cells += 1.0;
    slips.push_back(cells > 0.0 ? sum / cells : std::numeric_limits<double>::quiet_NaN());
  };
  const auto ticks = static_cast<int>(std::lround(0.04 / tick));
  for (int i = 0; i <= ticks; ++i) {
    tip.x() = -0.02 + 0.04 * i / ticks;
    sand.move(bed, tip, tip, slip);
  }
  tip.z() = 0.02;
  sand.move(bed, tip, tip, slip);
  EXPECT_TRUE(bed.held().empty());
  return slips;
}

TEST(SandSide, SandSlipsAtTheSamePlacesWhateverTheTicks) {
  for (const double tick : {1e-4, 0.7e-3, 2.5e-3, 10e-3, 40e-3}) {
    const std::vector<double> slips = slips_of_a_drag(tick);
    ASSERT_GE(slips.size(), 11u) << tick;  // as it touches down, nine or ten times, as it leaves
    ASSERT_LE(slips.size(), 12u) << tick;
    for (int i = 0; i < 10; ++i) EXPECT_NEAR(slips[i], -0.02 + 0.004 * i, 0.5 * 0.002 + 1e-9) << tick;
    EXPECT_TRUE(std::isnan(slips.back())) << tick;
  }
}

TEST(SandSide, ALiftedToolHoldsNothing) {
  HeightField bed(100, 100, 0.002);
  SandSide sand({0.01, ToolProfile::sphere, true}, {Deposit::outward}, 0.0);
  const Eigen::Vector3d tip(0.0, 0.0, -0.003);
  sand.move(bed, tip, tip, no_slip);
  sand.hold(bed);
  EXPECT_FALSE(bed.held().empty());
  sand.lift();
  sand.hold(bed);
  EXPECT_TRUE(bed.held().empty());

  SandSide hollow({0.01, ToolProfile::sphere}, {Deposit::outward}, 0.0);
  hollow.move(bed, tip, tip, no_slip);
  hollow.hold(bed);
  EXPECT_TRUE(bed.held().empty());
}

}  // namespace
}  // namespace sandstroke
