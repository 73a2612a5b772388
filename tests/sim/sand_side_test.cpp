#include "sim/sand_side.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "sand/sphere_tool.h"

namespace sandstroke {
namespace {

const std::function<void()> no_slip = [] {};

TEST(SandSide, AFastTickDisplacesAsTicksInBetweenWould) {
  // Sums and differences of these are exact, so that all bits are the same.
  const Eigen::Vector3d from(-0.0205078125, 0.0029296875, -0.001953125),
      to(0.0302734375, -0.009765625, -0.0068359375);
  const ToolSettings tool{0.01, ToolProfile::sphere};
  const DisplacementSettings ahead{Deposit::ahead};
  HeightField one(100, 100, 0.002), many = one;
  SandSide fast(tool, ahead);
  fast.move(one, from, from, no_slip);
  const double volume = fast.move(one, to, to, no_slip).displaced_volume;

  const int steps = 11;  // 52.3 mm along the bed in steps of half a radius at most
  SphereTool sphere(tool);
  double expected = 0.0;
  for (int i = 0; i <= steps; ++i) {
    const Eigen::Vector3d tip = i == steps ? to : Eigen::Vector3d(from + i / double{steps} * (to - from));
    sphere.place(many, tip.x(), tip.y());
    const Eigen::Vector3d motion = i == 0 ? Eigen::Vector3d::Zero() : Eigen::Vector3d(to - from);
    const double moved = sphere.displace(many, tip.z(), motion, ahead);
    if (i > 0) expected += moved;
  }
  EXPECT_GT(expected, 0.0);
  EXPECT_EQ(volume, expected);
  EXPECT_TRUE((one.grid() == many.grid()).all());
  EXPECT_NEAR(one.volume(), 0.0, 1e-12 * volume);
}

/// The volume that a second tick there displaces, after a first one here that displaces nothing (in the air).
double displaced_between(HeightField& bed, const Eigen::Vector3d& here, const Eigen::Vector3d& there) {
  SandSide sand({0.01, ToolProfile::sphere}, {Deposit::ahead});
  EXPECT_EQ(sand.move(bed, here, here, no_slip).displaced_volume, 0.0);
  return sand.move(bed, there, there, no_slip).displaced_volume;
}

TEST(SandSide, ATickOfHalfARadiusDisplacesOnlyWhereItEnds) {
  HeightField path(100, 100, 0.002), there = path;
  const Eigen::Vector3d to(0.0049, 0.0, -0.02);
  const double volume = displaced_between(path, {0.0, 0.0, 0.001}, to);
  SphereTool tool({0.01, ToolProfile::sphere});
  tool.place(there, to.x(), to.y());
  EXPECT_EQ(volume, tool.displace(there, to.z(), {0.0049, 0.0, -0.021}, {Deposit::ahead}));
  EXPECT_TRUE((path.grid() == there.grid()).all());
}

TEST(SandSide, DisplacesNothingInTheAirOrBesideTheBed) {
  HeightField bed(100, 100, 0.002);
  EXPECT_EQ(displaced_between(bed, {-0.05, 0.0, 0.001}, {0.05, 0.0, 0.001}), 0.0);
  EXPECT_EQ(displaced_between(bed, {-5.0, 3.0, -0.01}, {5.0, 3.0, -0.01}), 0.0);
  EXPECT_EQ(bed.allocated_tiles(), 0);
}

TEST(SandSide, DisplacesOnlyAlongTheWayThroughSandFromBeyondAllMeasure) {
  for (const double far : {1.0, 1e6, 1e20, 1e300}) {
    HeightField bed(100, 100, 0.002);
    const double volume = displaced_between(bed, {-far, 0.0, -0.005}, {far, 0.0, -0.005});
    EXPECT_TRUE(std::isfinite(volume));
    EXPECT_TRUE(bed.grid().isFinite().all());
    EXPECT_NEAR(bed.volume(), 0.0, 1e-12 * std::max(volume, 1e-9));
    if (far < 1e10) {
      EXPECT_LT(bed(49, 50), -0.003);
    }
  }
}

/// The positions where sand relaxes along a drag of 40 mm in ticks of this length [m].
std::vector<double> relaxations_of_a_drag(double tick) {
  HeightField bed(100, 100, 0.002);
  RelaxationSettings relaxation;
  relaxation.way = 0.4;
  SandSide sand({.radius = 0.01, .profile = ToolProfile::sphere, .solid = true}, {Deposit::outward},
                relaxation);
  std::vector<double> relaxations;
  Eigen::Vector3d tip(-0.02, 0.0, -0.003);
  const auto relax = [&] {
    sand.make_walls(bed);
    // Held are the cells under the tool where it is now: their middle.
    double sum = 0.0, cells = 0.0;
    for (int col = 0; col < 100; ++col)
      if (bed.is_wall(50, col)) {
        sum += bed.x_of(col);
        cells += 1.0;
      }
    relaxations.push_back(cells > 0.0 ? sum / cells : std::numeric_limits<double>::quiet_NaN());
    sand.relaxed(bed);
  };
  const auto ticks = static_cast<int>(std::lround(0.04 / tick));
  for (int i = 0; i <= ticks; ++i) {
    tip.x() = -0.02 + 0.04 * i / ticks;
    sand.move(bed, tip, tip, relax);
  }
  tip.z() = 0.02;
  sand.move(bed, tip, tip, relax);
  EXPECT_TRUE(bed.tool_walls().empty());
  return relaxations;
}

TEST(SandSide, RelaxesAtTheSamePositionsWhateverTheTicks) {
  for (const double tick : {1e-4, 0.7e-3, 2.5e-3, 10e-3, 40e-3}) {
    const std::vector<double> relaxations = relaxations_of_a_drag(tick);
    ASSERT_GE(relaxations.size(), 11u) << tick;  // as it touches down, nine or ten times, as it leaves
    ASSERT_LE(relaxations.size(), 12u) << tick;
    for (int i = 0; i < 10; ++i) EXPECT_NEAR(relaxations[i], -0.02 + 0.004 * i, 0.5 * 0.002 + 1e-9) << tick;
    EXPECT_TRUE(std::isnan(relaxations.back())) << tick;
  }
}

/// The number of relaxations in a drag of this length through flat sand, the tip this far below it [m].
int count_relaxations(const RelaxationSettings& relaxation, double depth, double length) {
  HeightField bed(100, 100, 0.002);
  SandSide sand({.radius = 0.01, .profile = ToolProfile::sphere, .solid = true}, {Deposit::outward},
                relaxation);
  int relaxations = 0;
  for (int i = 0; i <= 400; ++i) {
    const Eigen::Vector3d tip(-0.06 + length * i / 400, 0.0, -depth);
    sand.move(bed, tip, tip, [&] {
      ++relaxations;
      sand.relaxed(bed);
    });
  }
  return relaxations;
}

/// The way of the sphere of 10 mm [m] until sand relaxes again, where a step in front of it rises from its
/// rim by this [m].
double way_before_a_step(const RelaxationSettings& relaxation, double above_rim) {
  HeightField bed(100, 100, 0.002);
  for (int row = 0; row < 100; ++row)
    for (int col = 50; col < 100; ++col) bed.set(row, col, 0.007 + above_rim);
  SandSide sand({.radius = 0.01, .profile = ToolProfile::sphere, .solid = true}, {Deposit::outward},
                relaxation);
  sand.put(bed, {-0.0105, 0.0, -0.003}, true);
  sand.relaxed(bed);
  double way = 0.0;
  for (; !sand.relaxation_is_due() && way < 0.01; way += 1e-5)
    sand.put(bed, {-0.0105 - way, 0.0, -0.003}, true);
  return way;
}

TEST(SandSide, TheWayFallsAsSandRisesAtTheRim) {
  RelaxationSettings relaxation;
  relaxation.way = 0.4;
  EXPECT_NEAR(way_before_a_step(relaxation, 0.02), 0.004, 3e-5);
  relaxation.way_at_rim = 0.1;
  // The way falls from 0.4 R to 0.1 R while sand rises by R/5: half the way after half of that.
  EXPECT_NEAR(way_before_a_step(relaxation, -0.001), 0.004, 3e-5);
  EXPECT_NEAR(way_before_a_step(relaxation, 0.0), 0.004, 3e-5);
  EXPECT_NEAR(way_before_a_step(relaxation, 0.001), 0.002, 3e-5);
  EXPECT_NEAR(way_before_a_step(relaxation, 0.002), 0.001, 3e-5);
  EXPECT_NEAR(way_before_a_step(relaxation, 0.02), 0.001, 3e-5);
  relaxation.way_at_rim = 0.8;  // never a longer one
  EXPECT_NEAR(way_before_a_step(relaxation, 0.02), 0.004, 3e-5);
}

TEST(SandSide, RelaxesMoreOftenInDeepStrokes) {
  RelaxationSettings relaxation;
  relaxation.way = 0.4;
  relaxation.way_at_rim = 0.1;
  const auto relaxations = [&](double depth) { return count_relaxations(relaxation, depth, 0.042); };
  EXPECT_EQ(relaxations(0.003), 1 + 10);  // as it touches down, and every 4 mm of 42
  EXPECT_NEAR(relaxations(0.02), 42, 3);  // a radius below the sand: every 1 mm
}

TEST(SandSide, RelaxesEveryQuarterOfACellAtMost) {
  RelaxationSettings relaxation;
  relaxation.way = 1e-9;
  EXPECT_EQ(count_relaxations(relaxation, 0.003, 0.0052), 1 + 10);  // 5.2 mm in steps of 0.5 mm
}

TEST(SandSide, ALiftedToolHoldsNothing) {
  HeightField bed(100, 100, 0.002);
  SandSide sand({.radius = 0.01, .profile = ToolProfile::sphere, .solid = true}, {Deposit::outward});
  const Eigen::Vector3d tip(0.0, 0.0, -0.003);
  sand.move(bed, tip, tip, no_slip);
  sand.make_walls(bed);
  EXPECT_FALSE(bed.tool_walls().empty());
  sand.lift();
  sand.make_walls(bed);
  EXPECT_TRUE(bed.tool_walls().empty());

  SandSide hollow({0.01, ToolProfile::sphere}, {Deposit::outward});
  hollow.move(bed, tip, tip, no_slip);
  hollow.make_walls(bed);
  EXPECT_TRUE(bed.tool_walls().empty());
}

TEST(SandSide, BesideTheBedThereIsNoLevelAndNoContact) {
  HeightField bed(100, 100, 0.002);
  SandSide sand({0.01, ToolProfile::sphere}, {Deposit::ahead});
  for (const double height : {-1.0, 0.0, 1.0}) {
    const Eigen::Vector3d tip(0.5, 0.0, height);
    for (const Interaction& beside : {sand.look(bed, tip), sand.move(bed, tip, tip, no_slip)}) {
      EXPECT_TRUE(std::isnan(beside.level));
      EXPECT_FALSE(beside.contact);
      EXPECT_EQ(beside.depth, 0.0);
      EXPECT_EQ(beside.displaced_volume, 0.0);
    }
  }
}

TEST(SandSide, IsInContactBelowTheLevelAndNotAtIt) {
  const HeightField bed(100, 100, 0.002, std::make_shared<LevelRule>(0.25));
  SandSide sand({0.01, ToolProfile::sphere}, {Deposit::ahead});
  for (const double above : {-0.02, -1e-12, 0.0, 1e-12, 0.02}) {
    const Interaction seen = sand.look(bed, {0.01, -0.02, 0.25 + above});
    EXPECT_DOUBLE_EQ(seen.level, 0.25);
    EXPECT_NEAR(seen.depth, -above, 1e-16);
    EXPECT_EQ(seen.contact, above < 0.0) << above;
  }
}

TEST(SandSide, ARakeThatGoesFarInATickLeavesFurrowsAndNoPits) {
  ToolSettings rake{.radius = 0.004, .profile = ToolProfile::sphere, .solid = true, .shape = ToolShape::rake};
  rake.teeth = 3;
  rake.spacing = 0.02;
  HeightField bed(120, 120, 0.001);
  SandSide side(rake, {Deposit::outward});
  const Eigen::Vector3d from(-0.03, 0.0, -0.003), to(0.03, 0.0, -0.003);
  side.move(bed, from, from, no_slip);
  side.move(bed, to, to, no_slip);
  for (const double y : {-0.02, 0.0, 0.02})
    for (double x = -0.025; x < 0.025; x += 0.001) EXPECT_LT(bed.height_at(x, y), -0.002) << x << ", " << y;
}

}  // namespace
}  // namespace sandstroke
