#include "rules/talus.h"

#include <gtest/gtest.h>

#include <cmath>

namespace sandstroke {
namespace {

constexpr double talus = 30.0;
const double t = std::tan(M_PI / 6.0);  // on cells of 1 m

TalusPass pass_over(const HeightGrid& heights, RelaxationLaw law, double share, CompensatedSum& moved) {
  const WallGrid walls = WallGrid::Zero(heights.rows(), heights.cols());
  return talus_pass(heights, walls, nullptr, talus_law(law, share, talus, 0.0, 1.0), moved);
}

TEST(TalusPass, PaperDividesTheExcessInProportionToTheDrops) {
  // A column 2 m high, beside it a cell 1 m high to the east, all else at 0: both are too steep for it.
  HeightGrid heights = HeightGrid::Zero(5, 5);
  heights(2, 2) = 2.0;
  heights(2, 3) = 1.0;
  CompensatedSum moved;
  const TalusPass pass = pass_over(heights, RelaxationLaw::paper, 0.5, moved);
  EXPECT_TRUE(pass.flows);
  EXPECT_NEAR(pass.residual, 2.0 / t - 1.0, 1e-12);
  const double dm = 0.5 * (2.0 - t), drops = 3 * 2.0 + 1.0 + 4 * 2.0;  // axis, and diagonals: 2 > sqrt(2) t
  EXPECT_NEAR(pass.heights(2, 2), 2.0 - dm, 1e-12);
  EXPECT_NEAR(pass.heights(2, 1), dm * 2.0 / drops, 1e-12);
  EXPECT_NEAR(pass.heights.sum(), 3.0, 1e-12);
}

TEST(TalusPass, EveryLawMovesAStraightSlopeByItsExcess) {
  // A cliff along the columns: a quarter of the excess over the talus flows across it.
  HeightGrid heights = HeightGrid::Zero(9, 8);
  heights.leftCols(4) = 3.0;
  for (const RelaxationLaw law : {RelaxationLaw::isotropic, RelaxationLaw::faces}) {
    CompensatedSum moved;
    const TalusPass pass = pass_over(heights, law, 0.25, moved);
    const double flow = 0.25 * (3.0 - t);
    EXPECT_NEAR(pass.heights(4, 3), 3.0 - flow, 1e-12);
    EXPECT_NEAR(pass.heights(4, 4), flow, 1e-12);
    EXPECT_NEAR(moved.value(), 9 * flow, 1e-12);
  }
}

TEST(TalusPass, MovesNothingAtTheTalusAndInWalls) {
  HeightGrid heights(6, 6);
  for (int row = 0; row < 6; ++row)
    for (int col = 0; col < 6; ++col) heights(row, col) = 0.999 * t * col;
  for (const RelaxationLaw law : {RelaxationLaw::paper, RelaxationLaw::isotropic, RelaxationLaw::faces}) {
    CompensatedSum moved;
    EXPECT_FALSE(pass_over(heights, law, 0.25, moved).flows);
    const HeightGrid cliff = 10.0 * heights;
    WallGrid walls = WallGrid::Ones(6, 6);
    const TalusPass walled = talus_pass(cliff, walls, nullptr, talus_law(law, 0.25, talus, 0.0, 1.0), moved);
    EXPECT_FALSE(walled.flows);
    EXPECT_EQ(moved.value(), 0.0);
  }
}

}  // namespace
}  // namespace sandstroke
