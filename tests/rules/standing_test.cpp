#include "rules/standing.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

#include "rules/cuts.h"

namespace sandstroke {
namespace {

using namespace cuts;

// tests/validation/study and tests/accuracy measure at which order.
TEST(Standing, AVerticalCutStandsAt98PercentOfItsHeightAndFailsAt102) {
  for (const SlipSurface surface : {SlipSurface::spiral, SlipSurface::plane}) {
    const CohesionFactor factor(surface, friction_angle);
    const double exact = critical_height(surface, 90.0, friction_angle);
    for (const int cells : {20, 40})
      for (const double turn : {0.0, 11.0, 22.5, 45.0})
        for (const double part : {0.98, 1.02, 1.03}) {
          if (part == 1.02 && cells == 20 && turn > 22.0) continue;  // first order: 1.2 and 2.5 % too high
          Sand sand(static_cast<int>(3.2 * cells), exact / cells);
          const double x = std::cos(to_radians(turn)), y = std::sin(to_radians(turn));
          sand.lay([&](double at_x, double at_y) {
            return at_x * x + at_y * y > 0.1 * sand.cell ? part * exact : 0.0;
          });
          EXPECT_EQ(sand.look(factor).failed > 0, part > 1.0) << cells << " " << turn << " " << part;
        }
  }
}

TEST(Standing, ThinTowersStandLowerThanCuts) {
  const CohesionFactor factor(SlipSurface::plane, friction_angle);
  const double of_cut = critical_height(SlipSurface::plane, 90.0, friction_angle);
  EXPECT_NEAR(height_of_slab(0.5 * of_cut, of_cut) / of_cut, 0.884, 1e-3);  // the design's figures
  EXPECT_NEAR(height_of_slab(0.25 * of_cut, of_cut) / of_cut, 0.706, 1e-3);
  constexpr int cells = 40;
  for (const double width : {0.25, 0.5}) {
    const double exact = height_of_slab(width * of_cut, of_cut);
    const double stands = height_of_tower(factor, width * of_cut, of_cut, cells);
    EXPECT_NEAR(stands / exact, 1.0, 0.03) << width;
  }
}

// H = (c / gamma) (1 + T^2) / (T - mu), T the slope's: the infinite slope.
TEST(Standing, ALayerOnASteepFloorSlidesAtTheInfiniteSlopesThickness) {
  const CohesionFactor factor(SlipSurface::spiral, friction_angle);
  for (const double angle : {45.0, 60.0}) {
    const double T = std::tan(to_radians(angle)), mu = factor.friction(), exact = (1.0 + T * T) / (T - mu);
    constexpr int cells = 8;     // in the thickness
    const int run = 80 * cells;  // of the slope
    const double cell = exact / cells;
    const double stands = critical(0.8 * exact, 1.2 * exact, 10, [&](double thickness) {
      const int cols = run + 60 * cells, foot = 10 * cells;
      HeightGrid heights(3, cols), floor(3, cols);
      for (int col = 0; col < cols; ++col) {
        floor.col(col).setConstant(std::clamp((col + 0.5 - foot) * cell, 0.0, run * cell) * T);
        heights.col(col) = floor.col(col) + (col >= foot ? thickness : 0.0);
      }
      WallGrid walls = WallGrid::Constant(3, cols, true);
      walls(1, foot - 1) = false;
      return look_at_cuts(heights, heights, floor, HeightGrid::Ones(3, cols), walls, factor, cell).failed > 0;
    });
    EXPECT_NEAR(stands / exact, 1.0, 0.01) << angle;
  }
}

/// Rough blocks of sand, up to as high as `most`.
Sand rough(unsigned seed, int side, double most) {
  Sand sand(side, 0.1);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> height(0.0, most);
  HeightGrid blocks(side, side);
  for (double& one : blocks.reshaped()) one = height(random);
  for (int row = 0; row < side; ++row)
    for (int col = 0; col < side; ++col) sand.heights(row, col) = blocks(row / 6, col / 6);
  return sand;
}

TEST(Standing, MirroredAndTurnedBedsFailAlikeToTheBit) {
  const CohesionFactor factor(SlipSurface::spiral, friction_angle);
  const auto mirrored = [](const HeightGrid& grid) { return HeightGrid(grid.rowwise().reverse()); };
  const auto turned = [](const HeightGrid& grid) { return HeightGrid(grid.transpose()); };
  for (unsigned seed = 1; seed <= 3; ++seed) {
    const Sand sand = rough(seed, 60, 12.0);
    const CutsLook look = sand.look(factor);
    EXPECT_GT(look.failed, 10);
    for (const auto& change : {std::function(mirrored), std::function(turned)}) {
      Sand other = sand;
      other.heights = change(sand.heights);
      const CutsLook its = other.look(factor);
      EXPECT_EQ(its.failed, look.failed);
      EXPECT_TRUE((its.intact == change(look.intact)).all());
    }
  }
}

TEST(Standing, TwiceTheCohesionInSandTwiceAsLargeHasTheSameBits) {
  const CohesionFactor factor(SlipSurface::spiral, friction_angle);
  const Sand sand = rough(4, 60, 12.0);
  Sand twice = sand;
  twice.heights *= 2.0;
  twice.cell *= 2.0;
  twice.cohesion *= 2.0;
  const CutsLook one = sand.look(factor), other = twice.look(factor);
  EXPECT_EQ(one.failed, other.failed);
  EXPECT_TRUE((other.intact == 2.0 * one.intact).all());
}

TEST(Standing, TheLevelStaysBetweenFloorAndSandAndNoWedgeFailsOnItsOwnChord) {
  const CohesionFactor factor(SlipSurface::spiral, friction_angle);
  Sand sand = rough(5, 60, 20.0);
  sand.floor = 0.4 * sand.heights;
  const CutsLook look = sand.look(factor);
  EXPECT_GT(look.failed, 10);
  EXPECT_TRUE((look.intact <= sand.heights).all());
  EXPECT_TRUE((look.intact >= sand.floor).all());
}

TEST(Standing, AFloorBelowTheToesChangesNoBit) {
  const CohesionFactor factor(SlipSurface::spiral, friction_angle);
  const Sand deep = rough(7, 60, 12.0);
  Sand shallow = deep;
  shallow.floor.setConstant(deep.heights.minCoeff());
  EXPECT_TRUE((shallow.look(factor).intact == deep.look(factor).intact).all());
}

TEST(Standing, LowSandIsNotLookedAt) {
  const CohesionFactor factor(SlipSurface::spiral, friction_angle);
  EXPECT_EQ(rough(6, 60, 0.999 * factor.safe_height()).look(factor).toes, 0);
  EXPECT_GT(rough(6, 60, 2.0 * factor.safe_height()).look(factor).toes, 0);
}

}  // namespace
}  // namespace sandstroke
