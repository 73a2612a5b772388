#include "sweep/slopes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <memory>
#include <numbers>

#include "sand/all_laws.h"
#include "sand/ground.h"
#include "sand/relaxation.h"

namespace sandstroke {
namespace {

constexpr double cell_size = 0.01;
double degrees(double slope) { return std::atan(slope) * 180.0 / std::numbers::pi; }

RelaxationSettings talus(double angle) { return {.talus_angle = angle}; }

HeightField bed_of(int side, const std::function<double(double x, double y)>& height) {
  HeightField bed(side, side, cell_size);
  for (int row = 0; row < side; ++row)
    for (int col = 0; col < side; ++col) bed.set(row, col, height(bed.x_of(col), bed.y_of(row)));
  return bed;
}

TEST(DescentSlope, IsExactOnPlanesOfAnyDirection) {
  for (int turn = 0; turn < 64; ++turn) {
    const double angle = turn * std::numbers::pi / 32;
    const HeightField bed =
        bed_of(5, [&](double x, double y) { return 0.7 * (x * std::cos(angle) + y * std::sin(angle)); });
    EXPECT_NEAR(descent_slope(bed, 2, 2), 0.7, 1e-13) << angle;
  }
}

TEST(DescentSlope, OnACrestIsItsFlanksAndInAPitZero) {
  const HeightField crest = bed_of(9, [](double, double y) { return -0.5 * std::abs(y); });
  EXPECT_NEAR(descent_slope(crest, 4, 4), 0.5, 1e-13);
  const HeightField diagonal = bed_of(9, [](double x, double y) { return -0.5 * std::abs(x - y); });
  EXPECT_NEAR(descent_slope(diagonal, 4, 4), 0.5 * std::numbers::sqrt2, 1e-13);
  const HeightField pit = bed_of(9, [](double x, double y) { return std::hypot(x, y); });
  EXPECT_EQ(descent_slope(pit, 4, 4), 0.0);
}

TEST(DescentSlope, NothingFallsBeyondAWall) {
  const HeightField bed = bed_of(4, [](double x, double) { return 0.5 * x; });
  EXPECT_NEAR(descent_slope(bed, 0, 3), 0.5, 1e-13);  // down along the wall
  EXPECT_EQ(descent_slope(bed, 0, 0), 0.0);           // the lowest column
  EXPECT_EQ(descent_slope(HeightField(HeightGrid::Constant(1, 1, 3.0), cell_size), 0, 0), 0.0);
}

TEST(DescentSlope, IsAConesUpToTheBendOfItsContours) {
  // The way down turns by 1 / distance; half of a cell's turn on the triangle's first side, one and a
  // half on its second, which begins a cell away.
  const HeightField cone = bed_of(101, [](double x, double y) { return -0.6 * std::hypot(x, y); });
  for (int row = 1; row < 100; ++row)
    for (int col = 1; col < 100; ++col) {
      const double distance = std::hypot(cone.x_of(col), cone.y_of(row)) - std::numbers::sqrt2 * cell_size;
      if (distance < cell_size) continue;
      EXPECT_NEAR(descent_slope(cone, row, col), 0.6, 0.6 * 2.0 * cell_size / distance) << row << ' ' << col;
    }
  // The slope at the tip is that of the octagonal pyramid through the cells around it.
  EXPECT_NEAR(descent_slope(cone, 50, 50), 0.6 * std::hypot(1.0, std::numbers::sqrt2 - 1.0), 1e-13);
}

TEST(LawSlope, OnAPlaneIsTheLawsOwn) {
  // The paper's law looks in eight directions; the others see the plane's slope.
  for (int turn = 0; turn < 64; ++turn) {
    const double angle = turn * std::numbers::pi / 32;
    const HeightField bed =
        bed_of(5, [&](double x, double y) { return 0.7 * (x * std::cos(angle) + y * std::sin(angle)); });
    const double off = std::remainder(angle, std::numbers::pi / 4);  // from the nearest of the eight
    EXPECT_NEAR(law_slope(bed, 2, 2, RelaxationLaw::paper), 0.7 * std::cos(off), 1e-13) << angle;
    EXPECT_NEAR(law_slope(bed, 2, 2, RelaxationLaw::isotropic), 0.7, 1e-13) << angle;
    EXPECT_NEAR(law_slope(bed, 2, 2, RelaxationLaw::faces), 0.7, 1e-13) << angle;
  }
}

TEST(LawSlope, OnAPeakIsOfTheSteeperSidesAndInAPitAndOnAWallZero) {
  HeightField bed(3, 3, cell_size);
  bed.set(1, 1, 3.0 * cell_size);
  bed.set(1, 0, 2.0 * cell_size);
  bed.set(0, 1, cell_size);
  bed.set(2, 1, -cell_size);
  EXPECT_NEAR(law_slope(bed, 1, 1, RelaxationLaw::paper), 4.0, 1e-13);
  EXPECT_NEAR(law_slope(bed, 1, 1, RelaxationLaw::isotropic), std::hypot(3.0, 4.0), 1e-13);
  // The slope to the right, or below: a crest that falls by 3 and 1, or 4 and 2, and half of either's rise
  // across it and at the other cell.
  EXPECT_NEAR(law_slope(bed, 1, 1, RelaxationLaw::faces),
              std::hypot(4.0 + 2.0 * 2.0 / (3.0 * 4.0), 0.5 * (0.5 * (3.0 - 1.0) + 0.0)), 1e-13);
  EXPECT_EQ(law_slope(bed, 2, 1, RelaxationLaw::paper), 0.0);
  EXPECT_EQ(law_slope(bed, 2, 1, RelaxationLaw::isotropic), 0.0);
  const HeightField alone(HeightGrid::Constant(1, 1, 3.0), cell_size);
  EXPECT_EQ(law_slope(alone, 0, 0, RelaxationLaw::paper), 0.0);
  EXPECT_EQ(law_slope(alone, 0, 0, RelaxationLaw::isotropic), 0.0);
}

TEST(Slopes, AreAtMostTalusAngleAndResidualByTheLawAtRest) {
  for (const RelaxationLaw law : all_laws)
    for (const RelaxationMethod method : {RelaxationMethod::passes, RelaxationMethod::rkl})
      for (const double angle : {10.0, 20.0, 35.0, 45.0}) {
        const HeightField before = bed_of(64, [&](double x, double y) {
          return std::hypot(x, y) < 0.12 ? 0.2 * std::tan(angle * std::numbers::pi / 180.0) : 0.0;
        });
        HeightField after = before;
        const RelaxationSettings settings{.law = law, .method = method, .talus_angle = angle};
        const RelaxationOutcome outcome = make_relaxer(settings, cell_size)->relax(after);
        ASSERT_TRUE(outcome.converged);
        const double limit = std::tan(angle * std::numbers::pi / 180.0) * (1.0 + outcome.residual);
        const SlopeMeasures measures = measure_slopes(before, after, settings);
        EXPECT_LE(measures.law_steepest, degrees(limit) + 1e-9) << angle;
        EXPECT_GT(measures.law_steepest, angle - 0.5);  // there is a flank
        if (outcome.residual > 0.0) {
          EXPECT_NEAR(measures.law_steepest, degrees(limit), 1e-9) << angle;
        }
        if (law == RelaxationLaw::paper) {
          EXPECT_GE(measures.steepest, measures.law_steepest);  // which looks in fewer directions
        }
      }
}

TEST(Slopes, AreOfCellsThatChanged) {
  const HeightField before = bed_of(100, [](double, double y) { return 0.1 * y; });
  HeightField after = before;
  // Rows 20 to 79 are tilted the other way, about the middle.
  for (int row = 20; row < 80; ++row)
    for (int col = 0; col < 100; ++col) after.set(row, col, -0.5 * after.y_of(row));
  const SlopeMeasures measures = measure_slopes(before, after, talus(degrees(0.5) + 0.9));
  // The first tilted row looks down its slope; the last one too, on the old bed's side, as a cliff.
  const double cliff = degrees((after(79, 0) - after(80, 0)) / cell_size), flank = degrees(0.5);
  const double first = degrees(std::max(0.5, (after(20, 0) - after(19, 0)) / cell_size));
  EXPECT_LT(cliff, 0.0);  // the lowest row is a gutter
  EXPECT_NEAR(measures.mean, (58.0 * flank + first) / 60.0, 1e-10);
  EXPECT_NEAR(measures.steepest, std::max(first, flank), 1e-10);
  EXPECT_NEAR(measures.law_steepest, std::max(first, flank), 1e-10);  // along an axis
  EXPECT_NEAR(measures.fraction_at_talus, 58.0 / 60.0, 1e-15);
  EXPECT_EQ(measure_slopes(before, after, talus(flank + 1.1)).fraction_at_talus, 0.0);
}

TEST(Slopes, NothingChangedMeansNone) {
  const HeightField bed = bed_of(20, [](double x, double) { return 0.4 * x; });
  const SlopeMeasures measures = measure_slopes(bed, bed, talus(30.0));
  EXPECT_TRUE(std::isnan(measures.mean) && std::isnan(measures.steepest) &&
              std::isnan(measures.law_steepest) && std::isnan(measures.fraction_at_talus));
}

TEST(Slopes, LookOnlyAtTilesOnTheLargestBed) {
  const HeightField before(65536, 65536, cell_size);
  HeightField after = before;
  after.set(40000, 63, cell_size);  // beside a tile that does not exist
  const SlopeMeasures measures = measure_slopes(before, after, talus(45.0));
  EXPECT_NEAR(measures.mean, 45.0, 1e-12);
  EXPECT_NEAR(measures.fraction_at_talus, 1.0, 0.0);
}

TEST(Slopes, AreAtMostTheOctagonsAtRestByThePapersLaw) {
  // Drops to axis neighbours of at most T and to diagonal ones of at most sqrt 2 T bound a triangle's slope
  // by sqrt(1 + (sqrt 2 - 1)^2) = 1.0824 T.
  const HeightField before = bed_of(96, [](double x, double y) {
    return std::hypot(x, y) < 0.2 ? 0.15 : 0.01 * std::sin(50.0 * x + 31.0 * y);
  });
  HeightField after = before;
  RelaxationSettings settings;
  settings.law = RelaxationLaw::paper;
  settings.talus_angle = 30.0;
  ASSERT_TRUE(make_relaxer(settings, cell_size)->relax(after).converged);
  const double octagon = std::hypot(1.0, std::numbers::sqrt2 - 1.0) * std::tan(std::numbers::pi / 6);
  const SlopeMeasures measures = measure_slopes(before, after, settings);
  EXPECT_LE(measures.steepest, degrees(octagon * (1.0 + settings.tolerance)) + 1e-9);
  EXPECT_GT(measures.steepest, 30.0);
  EXPECT_LT(measures.mean, measures.steepest);
}

TEST(Slopes, AreTheAngleOfACone) {
  const double slope = std::tan(std::numbers::pi / 6);
  const HeightField before(201, 201, cell_size);
  const HeightField cone =
      bed_of(201, [&](double x, double y) { return std::max(0.0, slope * (0.8 - std::hypot(x, y))); });
  const SlopeMeasures measures = measure_slopes(before, cone, talus(30.0));
  // Cells within r of the middle are off by 1 / r (cells) at most, the last ring at the foot by any amount.
  EXPECT_NEAR(measures.mean, 30.0, 0.5);
  EXPECT_GT(measures.fraction_at_talus, 0.9);
}

TEST(Slopes, OfSeveralSandsAreComparedWithTheirOwnTalusAngle) {
  // Sand at 25 deg to the west of a crest, at 35 deg to the east.
  const auto slope_at = [](double x) { return std::tan((x < 0.0 ? 25.0 : 35.0) * std::numbers::pi / 180.0); };
  const HeightField before(80, 80, cell_size);
  HeightField after = bed_of(80, [&](double x, double) { return 1.0 - std::abs(x) * slope_at(x); });
  auto ground = std::make_shared<Ground>(after, slope_at(-1.0));
  for (int row = 0; row < 80; ++row)
    for (int col = 40; col < 80; ++col) ground->talus_slopes.set(row, col, slope_at(1.0));
  EXPECT_LT(measure_slopes(before, after, talus(25.0)).fraction_at_talus, 0.55);
  after.lie_on(ground);
  EXPECT_GT(measure_slopes(before, after, talus(25.0)).fraction_at_talus, 0.95);
}

TEST(Slopes, AreNotThoseOfBareStones) {
  const HeightField before(80, 80, cell_size);
  HeightField after = bed_of(80, [](double x, double) { return std::max(0.1 * x, 0.0); });
  auto ground = std::make_shared<Ground>(after, -1.0, 0.5);
  ground->floor.set(40, 60, 5.0);
  const double sand_alone = measure_slopes(before, after, talus(30.0)).steepest;
  after.lie_on(ground);
  ASSERT_EQ(after(40, 60), 5.0);
  // What lies beside a stone is not steeper for it.
  EXPECT_EQ(measure_slopes(before, after, talus(30.0)).steepest, sand_alone);
}

}  // namespace
}  // namespace sandstroke
