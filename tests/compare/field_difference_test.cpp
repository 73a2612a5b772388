#include "compare/field_difference.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/error.h"

namespace sandstroke {
namespace {

TEST(FieldDifference, IsZeroForEqualSurfaces) {
  const HeightGrid surface = HeightGrid::Random(7, 5);
  const FieldDifference difference = field_difference(surface, surface, 0.1);
  EXPECT_EQ(difference.max, 0.0);
  EXPECT_EQ(difference.rms, 0.0);
  EXPECT_EQ(difference.volume, 0.0);
}

TEST(FieldDifference, OneCellGivesPositionRmsAndVolume) {
  const HeightGrid golden = HeightGrid::Zero(4, 9);
  HeightGrid run = golden;
  run(3, 6) = -0.25;
  const FieldDifference difference = field_difference(golden, run, 0.5);
  EXPECT_EQ(difference.max, 0.25);
  EXPECT_EQ(difference.row, 3);
  EXPECT_EQ(difference.col, 6);
  EXPECT_DOUBLE_EQ(difference.x, 1.0);   // two cells right of the middle of nine
  EXPECT_DOUBLE_EQ(difference.y, 0.75);  // one and a half above the middle of four
  EXPECT_EQ(difference.cells, 1);
  EXPECT_DOUBLE_EQ(difference.rms, 0.25 / 6.0);
  EXPECT_DOUBLE_EQ(difference.volume, -0.25 * 0.25);
}

TEST(FieldDifference, CostsWhatIsTouchedOfHugeBedsAndIsTheSame) {
  HeightField golden(65536, 65536, 0.5), run = golden;
  golden.set(40000, 7, 1.0);  // only on one side
  run.set(123, 60000, -2.0);
  run.set(123, 60001, 2.0);  // as large, and later
  const FieldDifference difference = field_difference(golden, run);
  EXPECT_EQ(difference.max, 2.0);
  EXPECT_EQ(difference.row, 123);
  EXPECT_EQ(difference.col, 60000);
  EXPECT_EQ(difference.cells, 3);
  EXPECT_DOUBLE_EQ(difference.rms, 3.0 / 65536.0);
  EXPECT_DOUBLE_EQ(difference.volume, -0.25);
}

TEST(FieldDifference, UntouchedTilesAtDifferentLevelsDiffer) {
  const HeightField golden(100, 100, 1.0), run(100, 100, 1.0, std::make_shared<LevelRule>(0.5));
  const FieldDifference difference = field_difference(golden, run);
  EXPECT_EQ(difference.max, 0.5);
  EXPECT_EQ(difference.cells, 100 * 100);
  EXPECT_DOUBLE_EQ(difference.volume, 5000.0);
}

TEST(FieldDifference, TheLargestOfSeveralAndTheFirstOfEqualOnes) {
  const HeightGrid golden = HeightGrid::Constant(3, 3, 1.0);
  HeightGrid run = golden;
  run(0, 1) += 0.125;
  run(1, 2) -= 0.5;
  run(2, 0) += 0.5;
  const FieldDifference difference = field_difference(golden, run, 1.0);
  EXPECT_EQ(difference.max, 0.5);
  EXPECT_EQ(difference.row, 1);
  EXPECT_EQ(difference.col, 2);
}

TEST(FieldDifference, ACellThatIsNotFiniteIsReportedBeforeAnyNumber) {
  for (const double value :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    HeightGrid golden = HeightGrid::Zero(3, 4);
    HeightGrid run = golden;
    run(0, 0) = 100.0;
    run(1, 2) = value;
    run(2, 3) = value;
    FieldDifference difference = field_difference(golden, run, 1.0);
    EXPECT_TRUE(std::isnan(difference.max));
    EXPECT_EQ(difference.row, 1);
    EXPECT_EQ(difference.col, 2);
    golden = run;  // the same on both sides is no better
    EXPECT_TRUE(std::isnan(field_difference(golden, run, 1.0).max));
  }
}

TEST(DifferingCells, AreTheSmallestRectangleAroundWhatDiffersByMoreThanTheLimit) {
  const HeightField golden(200, 300, 0.01);
  HeightField run = golden;
  EXPECT_TRUE(differing_cells(golden, run, 0.0).empty());
  run.set(20, 250, 1e-3);
  run.set(130, 30, -1e-3);
  run.set(199, 299, 1e-4);
  EXPECT_EQ(differing_cells(golden, run, 1e-4), (CellRange{20, 131, 30, 251}));
  EXPECT_TRUE(differing_cells(golden, run, 1e-3).empty());
  run.set(0, 0, std::numeric_limits<double>::quiet_NaN());
  EXPECT_EQ(differing_cells(golden, run, 1.0), (CellRange{0, 1, 0, 1}));
  EXPECT_THROW(differing_cells(golden, HeightField(200, 301, 0.01), 1.0), Error);
}

TEST(FieldDifference, RefusesDifferentShapes) {
  EXPECT_THROW(field_difference(HeightGrid::Zero(3, 4), HeightGrid::Zero(4, 3), 1.0), Error);
  EXPECT_THROW(field_difference(HeightGrid(), HeightGrid(), 1.0), Error);
}

}  // namespace
}  // namespace sandstroke
