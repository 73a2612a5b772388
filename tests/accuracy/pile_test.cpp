// Equilibrium shapes against their closed forms (study/exact_shapes.h).
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "sand/all_laws.h"
#include "sand/initial_surface.h"
#include "sand/relaxation.h"
#include "sanitized.h"
#include "validation/study/surface_error.h"

namespace sandstroke {
namespace {

HeightField collapsed(const SurfaceSettings& surface, RelaxationLaw law, int n, double tolerance = 1e-3) {
  HeightField bed = make_surface(surface, n, n, 2.0 / n);
  RelaxationSettings settings;
  settings.law = law;
  settings.tolerance = tolerance;
  EXPECT_TRUE(make_relaxer(settings, bed.cell_size())->relax(bed).converged);
  return bed;
}

/// Misplaced sand, of the sand that has to move.
double error_of_collapse(const SurfaceSettings& surface, RelaxationLaw law, int n,
                         const ExactSurface& exact) {
  return surface_error(collapsed(surface, law, n), make_surface(surface, n, n, 2.0 / n), exact).l1;
}

double cylinder_error(double radius, double height, int n) {
  SurfaceSettings cylinder;
  cylinder.kind = SurfaceKind::cylinder;
  cylinder.radius = radius;
  cylinder.height = height;
  return error_of_collapse(cylinder, RelaxationLaw::isotropic, n, collapsed_cylinder(radius, height, 30.0));
}

TEST(IsotropicPile, ACylinderBecomesTheExactConeAndTheErrorHalvesWithTheCells) {
  if (sanitized) GTEST_SKIP() << "long; what it runs through, shorter tests do";
  const double coarse = cylinder_error(0.45, 0.5, 128), fine = cylinder_error(0.45, 0.5, 256);
  EXPECT_LT(coarse, 0.007);
  EXPECT_LT(fine, 0.003);
  EXPECT_LT(fine, 0.5 * coarse);
}

TEST(IsotropicPile, ALowCylinderBecomesTheTruncatedCone) {
  const double coarse = cylinder_error(0.5, 0.2, 128), fine = cylinder_error(0.5, 0.2, 256);
  EXPECT_LT(coarse, 0.007);
  EXPECT_LT(fine, 0.5 * coarse);
}

/// Slope [deg] of the line through the surface at distances `near` and `far` [m] from the origin, in a
/// direction [deg].
double slope_along_ray(const HeightField& bed, double direction, double near, double far) {
  const double c = std::cos(direction * std::numbers::pi / 180.0),
               s = std::sin(direction * std::numbers::pi / 180.0);
  const auto height_at = [&](double r) {  // bilinear
    const double col = bed.col_at(r * c), row = bed.row_at(r * s);
    const int j = static_cast<int>(col), i = static_cast<int>(row);
    return std::lerp(std::lerp(bed(i, j), bed(i, j + 1), col - j),
                     std::lerp(bed(i + 1, j), bed(i + 1, j + 1), col - j), row - i);
  };
  return std::atan((height_at(far) - height_at(near)) / (far - near)) * 180.0 / std::numbers::pi;
}

TEST(PaperLaw, SandThatDrainsThroughAHoleLeavesTheOctagon) {
  // Every slope that sand has slid down is as steep as the law allows: 30 degrees along axes and diagonals,
  // and on the octagon's faces tan 30 sqrt(1 + (sqrt 2 - 1)^2), 32.0 degrees, between them.
  const int n = 81, centre = 40;
  HeightField bed(n, n, 2.0 / n);
  RelaxationSettings settings;
  const auto relaxer = make_relaxer(settings, bed.cell_size());
  for (int flowed = 1, rounds = 0; flowed && rounds < 5000; ++rounds) {
    bed.set(centre, centre, -0.25);
    flowed = static_cast<int>(relaxer->relax(bed).passes);
  }
  for (const double axis : {0.0, 45.0, 90.0, 135.0, 180.0, 225.0, 270.0, 315.0})
    EXPECT_NEAR(slope_along_ray(bed, axis, 0.08, 0.32), 30.0, 0.2) << axis;
  for (const double between : {22.5, 67.5, 112.5, 157.5, 202.5, 247.5, 292.5, 337.5})
    EXPECT_NEAR(slope_along_ray(bed, between, 0.08, 0.32), 32.0, 0.2) << between;

  const HeightField flat(n, n, 2.0 / n);
  EXPECT_LT(surface_error(bed, flat, drained_crater(0.25, 30.0, RelaxationLaw::paper)).l1, 0.002);
}

TEST(PaperLaw, NoPileIsSteeperThanTheOctagonAndACollapseReachesIt) {
  SurfaceSettings cylinder;
  cylinder.kind = SurfaceKind::cylinder;
  cylinder.radius = 0.3;
  cylinder.height = 0.5;
  const HeightField bed = collapsed(cylinder, RelaxationLaw::paper, 129);
  double steepest = 0.0;
  for (int row = 1; row < 128; ++row)
    for (int col = 1; col < 128; ++col)
      steepest = std::max(
          steepest, std::hypot(bed(row, col + 1) - bed(row, col - 1), bed(row + 1, col) - bed(row - 1, col)));
  EXPECT_NEAR(std::atan(steepest / (2.0 * bed.cell_size())) * 180.0 / std::numbers::pi, 32.0, 0.2);
  for (const double axis : {0.0, 90.0, 180.0, 270.0})
    EXPECT_NEAR(slope_along_ray(bed, axis, 0.1, 0.4), -30.0, 0.2) << axis;
}

class AllLaws : public testing::TestWithParam<RelaxationLaw> {};
INSTANTIATE_TEST_SUITE_P(Laws, AllLaws, testing::ValuesIn(all_laws), law_name);

TEST_P(AllLaws, ACliffBecomesARampCentredOnItsEdge) {
  SurfaceSettings cliff;
  cliff.kind = SurfaceKind::cliff;
  cliff.height = 0.4;
  for (const int n : {64, 128}) {
    // Slopes end between tan(talus) and 1.001 of it: so far is the ramp's sand misplaced, too.
    EXPECT_LT(error_of_collapse(cliff, GetParam(), n, collapsed_cliff(cliff.height, 30.0)), 1e-3) << n;
  }
}

TEST_P(AllLaws, ATrenchFillsFromBothSidesToAV) {
  const int n = 128;
  const double dx = 2.0 / n, w = 8 * dx, depth = 0.3;
  HeightField bed(16, n, dx);
  for (int row = 0; row < 16; ++row)
    for (int col = 0; col < n; ++col) bed.set(row, col, std::abs(bed.x_of(col)) < w ? -depth : 0.0);
  const HeightField start = bed;
  RelaxationSettings settings;
  settings.law = GetParam();
  ASSERT_TRUE(make_relaxer(settings, dx)->relax(bed).converged);
  const ExactTrench exact = filled_slot(w, depth, 30.0);
  ASSERT_LT(exact.depth(), depth);
  EXPECT_LT(surface_error(bed, start, exact).l1, 0.02);
  EXPECT_NEAR(bed.volume(), start.volume(), 1e-14);
}

}  // namespace
}  // namespace sandstroke
