// Equilibrium shapes against their closed forms (model.md, "Exact references").
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "sand/initial_surface.h"
#include "sand/relaxation.h"

namespace sandstroke {
namespace {

const double t = std::tan(std::numbers::pi / 6.0);

HeightField collapsed(const SurfaceSettings& surface, RelaxationLaw law, int n, double tolerance = 1e-3) {
  HeightField bed = make_surface(surface, n, n, 2.0 / n);
  RelaxationSettings settings;
  settings.law = law;
  settings.tolerance = tolerance;
  EXPECT_TRUE(make_relaxer(settings, bed.cell_size())->relax(bed).converged);
  return bed;
}

template <class Exact>
double l1_error(const HeightField& bed, const Exact& exact) {
  double error = 0.0, volume = 0.0;
  for (int row = 0; row < bed.rows(); ++row)
    for (int col = 0; col < bed.cols(); ++col) {
      const double e = exact(bed.x_of(col), bed.y_of(row));
      error += std::abs(bed(row, col) - e);
      volume += std::abs(e);
    }
  return error / volume;
}

double cylinder_error(double radius, double height, int n) {
  SurfaceSettings cylinder;
  cylinder.kind = SurfaceKind::cylinder;
  cylinder.radius = radius, cylinder.height = height;
  const double D = height / t;
  double plateau = 0.0, foot = std::cbrt(3.0 * radius * radius * D);
  if (height < std::sqrt(3.0) * radius * t) {
    plateau = (-3.0 * D + std::sqrt(36.0 * radius * radius - 3.0 * D * D)) / 6.0;
    foot = plateau + D;
  }
  return l1_error(collapsed(cylinder, RelaxationLaw::isotropic, n), [=](double x, double y) {
    return std::max(0.0, t * (foot - std::max(plateau, std::hypot(x, y))));
  });
}

TEST(IsotropicPile, ACylinderBecomesTheExactConeAndTheErrorHalvesWithTheCells) {
  const double coarse = cylinder_error(0.45, 0.5, 128), fine = cylinder_error(0.45, 0.5, 256);
  EXPECT_LT(coarse, 0.006);
  EXPECT_LT(fine, 0.0025);
  EXPECT_LT(fine, 0.5 * coarse);
}

TEST(IsotropicPile, ALowCylinderBecomesTheTruncatedCone) {
  const double coarse = cylinder_error(0.5, 0.2, 128), fine = cylinder_error(0.5, 0.2, 256);
  EXPECT_LT(coarse, 0.006);
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

  const auto octile = [](double x, double y) {
    return std::max(std::abs(x), std::abs(y)) +
           (std::numbers::sqrt2 - 1.0) * std::min(std::abs(x), std::abs(y));
  };
  EXPECT_LT(l1_error(bed, [&](double x, double y) { return std::min(0.0, -0.25 + t * octile(x, y)); }), 0.02);
}

TEST(PaperLaw, NoPileIsSteeperThanTheOctagonAndACollapseReachesIt) {
  SurfaceSettings cylinder;
  cylinder.kind = SurfaceKind::cylinder;
  cylinder.radius = 0.3, cylinder.height = 0.5;
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

class BothLaws : public testing::TestWithParam<RelaxationLaw> {};
INSTANTIATE_TEST_SUITE_P(Laws, BothLaws, testing::Values(RelaxationLaw::paper, RelaxationLaw::isotropic),
                         [](const auto& law) {
                           return law.param == RelaxationLaw::paper ? "paper" : "isotropic";
                         });

TEST_P(BothLaws, ACliffBecomesARampCentredOnItsEdge) {
  SurfaceSettings cliff;
  cliff.kind = SurfaceKind::cliff;
  cliff.height = 0.4;
  for (const int n : {64, 128}) {
    const HeightField bed = collapsed(cliff, GetParam(), n);
    const double error = l1_error(bed, [](double x, double) { return std::clamp(0.2 - t * x, 0.0, 0.4); });
    EXPECT_LT(error, 5e-4);  // half the tolerance: slopes end between tan(talus) and 1.001 of it
  }
}

TEST_P(BothLaws, ATrenchFillsFromBothSidesToAV) {
  // A slot 2 w wide and H deep, with H / t > w: its walls slip until they meet in a V of the talus angle. The
  // sand that fills the slot (2 w H less the V's remainder) comes off the edges, so the V has area t b^2 = 2
  // w H.
  const int n = 128;
  const double dx = 2.0 / n, w = 8 * dx, H = 0.3;
  HeightField bed(16, n, dx);
  for (int row = 0; row < 16; ++row)
    for (int col = 0; col < n; ++col) bed.set(row, col, std::abs(bed.x_of(col)) < w ? -H : 0.0);
  const double before = bed.volume();
  RelaxationSettings settings;
  settings.law = GetParam();
  ASSERT_TRUE(make_relaxer(settings, dx)->relax(bed).converged);
  const double half_width = std::sqrt(2.0 * w * H / t);
  ASSERT_LT(t * half_width, H);
  double error = 0.0;
  for (int col = 0; col < n; ++col)
    error += std::abs(bed(8, col) - std::min(0.0, -t * (half_width - std::abs(bed.x_of(col)))));
  EXPECT_LT(error * dx / (2.0 * w * H), 0.02);
  EXPECT_NEAR(bed.volume(), before, 1e-14);
}

}  // namespace
}  // namespace sandstroke
