#include "validation/study/exact_shapes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace sandstroke {
namespace {

constexpr double pi = std::numbers::pi;
const double t = std::tan(pi / 6.0);

/// The volume by the midpoint rule over a square of this half side.
double volume(const ExactSurface& surface, double half_side) {
  constexpr int n = 1000;
  const double dx = 2.0 * half_side / n;
  double sum = 0.0;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) sum += surface((j + 0.5) * dx - half_side, (i + 0.5) * dx - half_side);
  return sum * dx * dx;
}

TEST(ExactShapes, ACollapseKeepsItsVolume) {
  for (const double height : {0.05, 0.2, 0.5, 1.0}) {
    const double cylinder = pi * 0.3 * 0.3 * height;
    EXPECT_NEAR(volume(collapsed_cylinder(0.3, height, 30.0), 1.0) / cylinder, 1.0, 1e-4) << height;
  }
  EXPECT_NEAR(volume(collapsed_cone(0.3, 0.4, 30.0), 1.0) / (pi * 0.3 * 0.3 * 0.4 / 3.0), 1.0, 1e-4);
  EXPECT_NEAR(volume(collapsed_cliff(0.4, 30.0), 1.0) / (2.0 * 0.4), 1.0, 1e-4);
  EXPECT_NEAR(volume(filled_slot(0.125, 0.3, 30.0), 1.0) / -(2.0 * 2.0 * 0.125 * 0.3), 1.0, 1e-4);
}

TEST(ExactShapes, APlateauIsAsHighAsTheCylinderAndVanishesWhereTheConeIsFull) {
  const ExactCone low = collapsed_cylinder(0.5, 0.2, 30.0);
  EXPECT_NEAR(low.top(), 0.2, 1e-15);
  EXPECT_EQ(low(0.0, 0.5 * low.plateau), low.top());
  const double full = std::sqrt(3.0) * 0.5 * t;
  EXPECT_NEAR(collapsed_cylinder(0.5, full * (1.0 - 1e-9), 30.0).plateau, 0.0, 1e-8);
  EXPECT_NEAR(collapsed_cylinder(0.5, full * (1.0 - 1e-9), 30.0).foot,
              collapsed_cylinder(0.5, full, 30.0).foot, 1e-8);
}

TEST(ExactShapes, ConesAndCapsHaveTheirVolumes) {
  const ExactCone low = collapsed_cylinder(0.5, 0.2, 30.0), full{t, 0.0, 0.6};
  EXPECT_NEAR(low.volume() / volume(low, 1.0), 1.0, 1e-4);
  EXPECT_NEAR(full.volume() / (pi * 0.6 * 0.6 * 0.6 * t / 3.0), 1.0, 1e-14);
  const ExactCap cap{t, 0.8};
  EXPECT_NEAR(cap.foot(), 0.8 * std::sin(pi / 6.0), 1e-15);
  EXPECT_NEAR(cap.volume() / volume(cap, 0.5), 1.0, 1e-4);
  // The published form, of the slope's angle.
  const double s = std::sin(pi / 6.0), c = std::cos(pi / 6.0);
  EXPECT_NEAR(cap.volume() / (pi * 0.512 * (s * s * s * t / 3.0 - (1.0 - c) * (1.0 - c) * (2.0 + c) / 3.0)),
              1.0, 1e-12);
  EXPECT_NEAR(cap(0.0, 0.0), 0.8 / c - 0.8, 1e-15);
  EXPECT_NEAR(cap(0.3, 0.2645), 0.0, 1e-6);  // near its foot: it touches the sphere
  EXPECT_EQ(cap(0.3, 0.3), 0.0);
}

TEST(ExactShapes, AHeapOnAPlateIsAConeThatShrinksAsItIsTilted) {
  const double cone = ExactCone{t, 0.0, 0.05}.volume();
  EXPECT_NEAR((ExactHeapOnPlate{t, 0.05, 0.0}.volume()) / cone, 1.0, 1e-3);
  double before = cone;
  for (const double tilt : {10.0, 20.0, 25.0}) {
    const double here = ExactHeapOnPlate{t, 0.05, tilt}.volume();
    EXPECT_LT(here, 0.95 * before) << tilt;
    before = here;
  }
  EXPECT_LT((ExactHeapOnPlate{t, 0.05, 29.9}.volume()), 0.02 * cone);
  EXPECT_EQ((ExactHeapOnPlate{t, 0.05, 30.1}.volume()), 0.0);
  EXPECT_NEAR((ExactHeapOnPlate{t, 0.1, 20.0}.volume() / ExactHeapOnPlate{t, 0.05, 20.0}.volume()), 8.0,
              1e-9);
}

TEST(ExactShapes, ASeamsMeansAreThoseOfItsLines) {
  const ExactSeam seam{0.4, 0.7, 0.1};
  EXPECT_EQ(seam(0.1, 0.0), 0.0);
  EXPECT_NEAR(seam(-0.1, 3.0), 0.08, 1e-15);
  EXPECT_NEAR(seam(0.3, 0.0), -0.14, 1e-15);
  for (const double x : {0.0, 0.08, 0.1, 0.13, 0.4}) {
    double sum = 0.0;
    for (int i = 0; i < 1000; ++i) sum += seam(x + ((i + 0.5) / 1000 - 0.5) * 0.1, 0.0) / 1000;
    EXPECT_NEAR(seam.mean(x, 0.1), sum, 1e-7) << x;
  }
}

TEST(ExactShapes, TheOctagonIsAsSteepAsTheLawAllowsOnItsAxesAndTwoDegreesSteeperBetween) {
  const ExactCrater octagon = drained_crater(0.25, 30.0, RelaxationLaw::paper);
  const auto slope_at = [&](double angle) {
    const double x = std::cos(angle * pi / 180.0), y = std::sin(angle * pi / 180.0);
    return std::atan((octagon(0.3 * x, 0.3 * y) - octagon(0.1 * x, 0.1 * y)) / 0.2) * 180.0 / pi;
  };
  for (int i = 0; i < 8; ++i) {
    EXPECT_NEAR(slope_at(45.0 * i), 30.0, 1e-12) << i;
    EXPECT_NEAR(slope_at(45.0 * i + 22.5), std::atan(t * 1.0823922002923940) * 180.0 / pi, 1e-10) << i;
  }
  const ExactCrater cone = drained_crater(0.25, 30.0, RelaxationLaw::isotropic);
  EXPECT_NEAR(cone(0.06, 0.08), 0.1 * t - 0.25, 1e-15);
  EXPECT_EQ(cone(0.5, 0.5), 0.0);
}

TEST(ExactShapes, WorkIsTheForceAlongTheWay) {
  const ForceSettings force;
  constexpr int n = 100'000;
  double sum = 0.0;
  for (int i = 0; i < n; ++i) sum += repulse_force((i + 0.5) * 0.01 / n, force) * 0.01 / n;
  EXPECT_NEAR(plunge_work(0.01, force) / sum, 1.0, 1e-8);
  EXPECT_NEAR(drag_work(0.006, 0.1, 2.0, force), 10.0 * 0.1 * repulse_force(0.006, force) * 2.0, 1e-12);
}

TEST(ExactShapes, AStripCoversItsFractionOfADisk) {
  EXPECT_NEAR(strip_fraction_of_disk(2.0, 2.0), 1.0, 1e-15);
  EXPECT_NEAR(strip_fraction_of_disk(2.0, 5.0), 1.0, 1e-15);
  EXPECT_NEAR(strip_fraction_of_disk(1.0, 1e-6) / (4e-6 / pi), 1.0, 1e-9);
  EXPECT_NEAR(strip_fraction_of_disk(1.0, 0.5), (pi / 3.0 + std::sqrt(3.0) / 2.0) / pi, 1e-15);
}

}  // namespace
}  // namespace sandstroke
