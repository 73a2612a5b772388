#include "validation/study/surface_error.h"

#include <gtest/gtest.h>

#include <cmath>

namespace sandstroke {
namespace {

HeightField sampled(const ExactSurface& surface, int cells) {
  HeightField bed(cells, cells, 2.0 / cells);
  for (int row = 0; row < cells; ++row)
    for (int col = 0; col < cells; ++col) bed.set(row, col, surface(bed.x_of(col), bed.y_of(row)));
  return bed;
}

TEST(SurfaceError, IsNoneForTheShapeItselfAndOneWhereNothingHasMoved) {
  const ExactCone cone = collapsed_cone(0.3, 0.4, 30.0);
  const HeightField bed = sampled(cone, 64), flat(64, 64, 2.0 / 64);
  const SurfaceError none = surface_error(bed, flat, cone), all = surface_error(flat, flat, cone);
  EXPECT_EQ(none.l1, 0.0);
  EXPECT_EQ(none.rms, 0.0);
  EXPECT_EQ(none.largest, 0.0);
  EXPECT_NEAR(all.l1, 1.0, 1e-15);
  EXPECT_EQ(all.largest, bed.grid().maxCoeff());
}

TEST(SurfaceError, MeasuresInUnitsOfTheSandThatHasToMove) {
  HeightGrid start = HeightGrid::Zero(4, 4), exact = start, heights = start;
  exact(1, 1) = 3.0;
  exact(2, 2) = -1.0;  // 4 have to move
  heights(1, 1) = 2.0;
  heights(0, 0) = -1.0;  // and 3 are wrong
  heights(2, 2) = 0.0;
  const SurfaceError error = surface_error(heights, start, exact);
  EXPECT_DOUBLE_EQ(error.l1, 3.0 / 4.0);
  EXPECT_DOUBLE_EQ(error.rms, std::sqrt(3.0 / 16.0));
  EXPECT_DOUBLE_EQ(error.largest, 1.0);
}

TEST(FlankSlopes, AreRightInEveryDirectionUpAndDownAnExactCone) {
  const ExactCone cone = collapsed_cylinder(0.5, 0.2, 30.0);
  for (const double sign : {1.0, -1.0}) {
    const HeightField bed = sampled([&](double x, double y) { return sign * cone(x, y); }, 128);
    const std::vector<double> errors = flank_slope_errors(bed, {cone.slope, cone.plateau, cone.foot});
    ASSERT_EQ(errors.size(), flank_directions().size());
    for (const double error : errors) EXPECT_NEAR(error, 0.0, 1e-10);
  }
}

TEST(FlankSlopes, SeeTheDirectionThatIsSteeper) {
  // A plane that rises towards +y on top of a cone: steeper behind, gentler in front, the same at its sides.
  const double slope = 0.5;
  const HeightField bed =
      sampled([&](double x, double y) { return 1.0 - slope * std::hypot(x, y) - 0.05 * y; }, 256);
  const std::vector<double> errors = flank_slope_errors(bed, {slope, 0.0, 0.9}), at = flank_directions();
  for (std::size_t i = 0; i < at.size(); ++i) {
    const double expected = std::atan(slope + 0.05 * std::sin(at[i] * M_PI / 180.0)) - std::atan(slope);
    EXPECT_NEAR(errors[i], expected * 180.0 / M_PI, 0.02) << at[i];
  }
}

TEST(FlankSlopes, AreThoseOfAPlaneInAnyDirectionBetweenTwoHeights) {
  // A roof whose ridge is turned: its sides fall by 0.4 and 0.7, and above 0.6 m it is cut off.
  const double turn = 22.5 * M_PI / 180.0;
  const HeightField bed = sampled(
      [&](double x, double y) {
        const double across = x * std::cos(turn) + y * std::sin(turn);
        return std::min(0.6, 0.8 - (across > 0.0 ? 0.4 : -0.7) * across);
      },
      128);
  EXPECT_NEAR(slope_along(bed, 22.5, 0.5, 0.58), std::atan(0.4) * 180.0 / M_PI, 1e-9);
  EXPECT_NEAR(slope_along(bed, 202.5, 0.3, 0.58), std::atan(0.7) * 180.0 / M_PI, 1e-9);
}

}  // namespace
}  // namespace sandstroke
