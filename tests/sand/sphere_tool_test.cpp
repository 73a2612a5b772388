#include "sand/sphere_tool.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

#include "sand/all_laws.h"
#include "sand/footprint_kernels.h"
#include "sand/relaxation.h"
#include "sand/symmetry.h"

namespace sandstroke {
namespace {

constexpr double R = 0.01, dx = 0.002;
const Eigen::Vector3d down(0.0, 0.0, -1e-4);

TEST(Displacement, TakesOutTheBowlAndHeapsTheRing) {
  HeightField bed(41, 41, dx);
  SphereTool tool({R, ToolProfile::sphere});
  tool.place(bed, 0.0, 0.0);
  const double tip = -0.004;
  const double volume = tool.displace(bed, tip, down, {Deposit::ring});

  // The rule by hand: every cell under the sphere is cut to its underside; the ring takes what was cut by
  // sin(u) - 0.53.
  double cut = 0.0, weights = 0.0;
  const double s2 = R * R / std::asin(0.53);
  for (int row = 0; row < 41; ++row)
    for (int col = 0; col < 41; ++col) {
      const double rho2 = std::pow((col - 20) * dx, 2) + std::pow((row - 20) * dx, 2);
      if (rho2 <= R * R) cut += std::max(0.0, -(tip + R - std::sqrt(R * R - rho2)));
      const double u = rho2 / s2;
      if (u > std::asin(0.53) && u <= filter::u1) weights += std::sin(u) - 0.53;
    }
  EXPECT_NEAR(volume, cut * dx * dx, 1e-15);
  EXPECT_NEAR(bed(20, 20), tip, 1e-16);
  EXPECT_NEAR(bed(20, 23), tip + R - std::sqrt(R * R - 36e-6), 1e-16);
  EXPECT_NEAR(bed(20, 26), cut * (std::sin(144e-6 / s2) - 0.53) / weights, 1e-15);
  EXPECT_NEAR(bed.volume(), 0.0, 1e-12 * volume);
}

TEST(Displacement, KeepsTheSandLevelUnderAToolAtRest) {
  HeightField bed(60, 60, dx);
  SphereTool tool({R, ToolProfile::paper});
  tool.place(bed, 0.0007, -0.0003);
  const double before = tool.sand_level();
  ASSERT_GT(tool.displace(bed, -0.006, down, {Deposit::ring}), 0.0);
  tool.place(bed, 0.0007, -0.0003);
  EXPECT_NEAR(tool.sand_level(), before, 1e-15);
}

TEST(Displacement, APlungeAtACellCentreIsSymmetricToTheBit) {
  for (const ToolProfile profile : {ToolProfile::paper, ToolProfile::sphere})
    for (const Deposit deposit : {Deposit::ring, Deposit::ahead, Deposit::outward})
      for (const RelaxationLaw law : all_laws) {
        HeightField bed(129, 129, dx);  // the tile border runs through the patch
        SphereTool tool({R, profile});
        RelaxationSettings relaxation;
        relaxation.law = law;
        const auto relaxer = make_relaxer(relaxation, dx);
        for (int i = 1; i <= 30; ++i) {
          tool.place(bed, 0.0, 0.0);
          tool.displace(bed, -3e-4 * i, down, {deposit});
          relaxer->relax(bed);
        }
        EXPECT_TRUE(has_square_symmetry(bed.grid()));
        EXPECT_LT(bed(64, 64), -0.002);
      }
}

TEST(Displacement, AheadPutsNothingBehindADragAndRingPutsHalfThere) {
  for (const Deposit deposit : {Deposit::ring, Deposit::ahead}) {
    HeightField bed(61, 61, dx);
    SphereTool tool({R, ToolProfile::sphere});
    tool.place(bed, 0.0, 0.0);
    tool.displace(bed, -0.004, {1e-4, 0.0, 0.0}, {deposit});
    double ahead = 0.0, behind = 0.0;
    for (int row = 0; row < 61; ++row)
      for (int col = 0; col < 61; ++col) {
        if (bed(row, col) <= 0.0) continue;
        (bed.x_of(col) > 0.75 * dx ? ahead : bed.x_of(col) < -0.75 * dx ? behind : ahead) += bed(row, col);
      }
    if (deposit == Deposit::ahead) {
      EXPECT_EQ(behind, 0.0);
    } else {
      EXPECT_GT(behind, 0.35 * (ahead + behind));
    }
  }
}

TEST(Displacement, ConservesVolumeAnywhereAtWallsAndCorners) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> coordinate(-0.065, 0.065), height(-0.002, 0.002),
      motion(-1e-3, 1e-3);
  for (int i = 0; i < 300; ++i) {
    HeightField bed(60, 60, dx);
    for (int row = 0; row < 60; ++row)
      for (int col = 0; col < 60; ++col) bed.set(row, col, height(random));
    const double before = bed.volume();
    SphereTool tool({R, ToolProfile::paper});
    tool.place(bed, coordinate(random), coordinate(random));
    const double moved = tool.displace(bed, -0.005, {motion(random), motion(random), motion(random)},
                                       {std::array{Deposit::ring, Deposit::ahead, Deposit::outward}[i % 3]});
    EXPECT_NEAR(bed.volume(), before, 1e-15 * 3600 * 0.002 * dx * dx + 1e-12 * moved);
  }
}

TEST(Displacement, OutwardCarriesEachCellsSandAlongItsOwnNormal) {
  // One grain, at an angle from the axis, lands at that angle, `distance` radii away: in thirds, as the three
  // thirds of its cell lie side by side round the axis. Their positions between cells are kept (their mean
  // position is theirs), and nothing depends on the motion.
  for (const double angle : {0.0, 0.3, 1.2, 2.5, 4.0})
    for (const double axis : {0.0, 0.0007}) {
      HeightField bed(61, 61, dx);
      const double x = axis + 3.0 * dx * std::cos(angle), y = 3.0 * dx * std::sin(angle);
      const int row = static_cast<int>(std::lround(bed.row_at(y))),
                col = static_cast<int>(std::lround(bed.col_at(x)));
      bed.set(row, col, 0.005);
      SphereTool tool({R, ToolProfile::sphere});
      tool.place(bed, axis, 0.0);
      tool.meet(bed, std::numeric_limits<double>::infinity());
      const double tip =
          0.005 - 1e-4 -
          tool.footprint().underside(
              row - tool.footprint().cells().row_begin)[col - tool.footprint().cells().col_begin];
      HeightField other = bed;
      const double volume = tool.displace(bed, tip, down, {Deposit::outward, 1.3});
      EXPECT_NEAR(volume, 1e-4 * dx * dx, 1e-18);
      Eigen::Vector2d centre = Eigen::Vector2d::Zero();
      for (int r = 0; r < 61; ++r)
        for (int c = 0; c < 61; ++c)
          if (r != row || c != col)
            centre += bed(r, c) * dx * dx / volume * Eigen::Vector2d(bed.x_of(c) - axis, bed.y_of(r));
      const Eigen::Vector2d from_axis(bed.x_of(col) - axis, bed.y_of(row));
      const double apart = std::atan(dx / 3.0 / from_axis.norm()),
                   thirds = (1.0 + 2.0 * std::cos(apart)) / 3.0;
      EXPECT_LT((centre - 1.3 * R * thirds * from_axis.normalized()).norm(), 1e-9) << angle;
      tool.place(other, axis, 0.0);
      tool.displace(other, tip, {1e-3, -2e-3, 0.0}, {Deposit::outward, 1.3});
      EXPECT_TRUE((other.grid() == bed.grid()).all());
    }
}

TEST(Displacement, OutwardGivesNothingToTheBowlAndTakesItOutOnce) {
  // A projection: what was taken out is out, so that a second time, at the same position, takes out nothing.
  std::mt19937 random(3);
  std::uniform_real_distribution<double> coordinate(-0.01, 0.01), height(-0.002, 0.002);
  for (int i = 0; i < 50; ++i) {
    HeightField bed(60, 60, dx);
    for (int row = 0; row < 60; ++row)
      for (int col = 0; col < 60; ++col) bed.set(row, col, height(random));
    const double x = coordinate(random), y = coordinate(random);
    SphereTool tool({R, ToolProfile::sphere});
    tool.place(bed, x, y);
    ASSERT_GT(tool.displace(bed, -0.006, down, {Deposit::outward}), 0.0);
    tool.place(bed, x, y);
    EXPECT_LT(tool.displace(bed, -0.006, down, {Deposit::outward}), 1e-15 * R * R * R);
  }
}

/// A sphere pressed in where its axis stands so many cells beyond the last column, dragged on towards the
/// wall.
HeightGrid dragged_against_the_wall(Deposit deposit, double cells_beyond) {
  HeightField bed(41, 41, dx);
  SphereTool tool({R, ToolProfile::sphere});
  tool.place(bed, (20.0 + cells_beyond) * dx, 0.0);
  EXPECT_GT(tool.displace(bed, -0.004, {1e-3, 0.0, 0.0}, {deposit}), 0.0);
  EXPECT_NEAR(bed.volume(), 0.0, 1e-20);
  return bed.grid();
}

TEST(Displacement, TheWholeRingTakesTheSandAtAWallWithNothingAhead) {
  // A cell lies ahead where it is less than half a cell behind the axis.
  const HeightGrid beyond = dragged_against_the_wall(Deposit::ahead, 0.525);
  EXPECT_TRUE((beyond == dragged_against_the_wall(Deposit::ring, 0.525)).all());
  EXPECT_TRUE((beyond == beyond.colwise().reverse()).all());
  EXPECT_GT(beyond.leftCols(39).maxCoeff(), 0.0);
  const HeightGrid before = dragged_against_the_wall(Deposit::ahead, 0.475);
  EXPECT_GT(before.col(40).maxCoeff(), 0.0);
  EXPECT_LE(before.leftCols(40).maxCoeff(), 0.0);
  EXPECT_TRUE((before == before.colwise().reverse()).all());
}

TEST(Displacement, AllWallsAndCornersAreAlike) {
  // Mirrored tools leave mirrored sand, also where walls cut the ring and the bowl.
  for (const Deposit deposit : {Deposit::ring, Deposit::ahead, Deposit::outward})
    for (const double across : {0.0, 0.0371}) {
      const auto at = [&](double x, double y, double drag_x, double drag_y) {
        HeightField bed(41, 41, dx);
        SphereTool tool({R, ToolProfile::paper});
        tool.place(bed, x, y);
        EXPECT_GT(tool.displace(bed, -0.004, {drag_x, drag_y, -2e-4}, {deposit}), 0.0);
        EXPECT_NEAR(bed.volume(), 0.0, 1e-20);
        return bed.grid();
      };
      const HeightGrid east = at(0.0387, across, 1e-3, 0.0);
      const HeightGrid west = at(-0.0387, across, -1e-3, 0.0), north = at(across, 0.0387, 0.0, 1e-3),
                       below = at(0.0387, -across, 1e-3, 0.0);
      EXPECT_LT((west - east.rowwise().reverse()).abs().maxCoeff(), 1e-15);
      EXPECT_LT((north - east.transpose()).abs().maxCoeff(), 1e-15);
      EXPECT_LT((below - east.colwise().reverse()).abs().maxCoeff(), 1e-15);
    }
}

TEST(Displacement, MovesNothingWhereNoRingIsInsideTheBed) {
  HeightField bed(4, 4, 0.002);  // the bowl covers all of it
  SphereTool tool({R, ToolProfile::paper});
  tool.place(bed, 0.0, 0.0);
  EXPECT_EQ(tool.displace(bed, -0.005, down, {Deposit::ring}), 0.0);
  EXPECT_TRUE((bed.grid() == 0.0).all());
}

}  // namespace
}  // namespace sandstroke
