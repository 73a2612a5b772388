#include "sand/initial_surface.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "sand/symmetry.h"

namespace sandstroke {
namespace {

SurfaceSettings kind(SurfaceKind k) {
  SurfaceSettings s;
  s.kind = k;
  return s;
}

TEST(DiskCellArea, AreasAddUpToTheDisk) {
  for (const int n : {10, 11, 64}) {
    double sum = 0.0;
    const double dx = 1.0 / n;
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j)
        sum += disk_cell_area(0.37, (j - 0.5 * (n - 1)) * dx, (i - 0.5 * (n - 1)) * dx, dx);
    EXPECT_NEAR(sum, std::numbers::pi * 0.37 * 0.37, 1e-14);
  }
}

TEST(DiskCellArea, KnownCells) {
  EXPECT_NEAR(disk_cell_area(0.5, 0.0, 0.0, 1.0), std::numbers::pi / 4.0, 1e-15);  // inscribed disk
  EXPECT_NEAR(disk_cell_area(1.0, 0.5, 0.5, 1.0), std::numbers::pi / 4.0, 1e-15);  // one quadrant
  EXPECT_NEAR(disk_cell_area(10.0, 1.5, -2.5, 1.0), 1.0, 1e-13);                   // wholly inside
  EXPECT_EQ(disk_cell_area(1.0, 2.5, 0.5, 1.0), 0.0);                              // wholly outside
}

TEST(Surface, CylinderHasItsVolumeAndSymmetryToTheBit) {
  SurfaceSettings s = kind(SurfaceKind::cylinder);
  s.radius = 0.3;
  s.height = 0.2;
  const HeightField bed = make_surface(s, 101, 101, 1.0 / 101);
  EXPECT_NEAR(bed.volume(), std::numbers::pi * 0.09 * 0.2, 1e-14);
  EXPECT_TRUE(has_square_symmetry(bed.grid()));
}

TEST(Surface, ConeHasItsVolume) {
  SurfaceSettings s = kind(SurfaceKind::cone);
  s.radius = 0.4;
  s.height = 0.2;
  const HeightField bed = make_surface(s, 200, 200, 1.0 / 200);
  EXPECT_NEAR(bed.volume(), std::numbers::pi * 0.16 * 0.2 / 3.0, 1e-6);
}

TEST(Surface, CliffIsHalfwayInTheMiddleCellOfAnOddBed) {
  SurfaceSettings s = kind(SurfaceKind::cliff);
  s.height = 1.0;
  const HeightField odd = make_surface(s, 1, 5, 0.1), even = make_surface(s, 1, 4, 0.1);
  EXPECT_EQ(odd(0, 1), 1.0);
  EXPECT_EQ(odd(0, 2), 0.5);
  EXPECT_EQ(odd(0, 3), 0.0);
  EXPECT_EQ(even(0, 1), 1.0);
  EXPECT_EQ(even(0, 2), 0.0);
}

TEST(Surface, NoiseIsReproducibleBoundedCentredAndSeeded) {
  for (const double wavelength : {0.0, 0.05}) {
    SurfaceSettings s = kind(SurfaceKind::noise);
    s.amplitude = 0.01;
    s.wavelength = wavelength;
    s.seed = 5;
    const HeightGrid a = make_surface(s, 200, 200, 0.005).grid(), b = make_surface(s, 200, 200, 0.005).grid();
    s.seed = 6;
    const HeightGrid other = make_surface(s, 200, 200, 0.005).grid();
    EXPECT_TRUE((a == b).all());
    EXPECT_FALSE((a == other).all());
    EXPECT_LE(a.abs().maxCoeff(), 0.01);
    EXPECT_GT(a.abs().maxCoeff(), 0.005);
    EXPECT_NEAR(a.mean(), 0.0, 0.0012);
  }
}

TEST(Surface, RipplesAreCellMeansOfASine) {
  SurfaceSettings s = kind(SurfaceKind::ripples);
  s.amplitude = 0.01;
  s.wavelength = 0.1;
  const HeightField bed = make_surface(s, 1, 40, 0.02);
  const double k = 2.0 * std::numbers::pi / 0.1;
  for (int col = 0; col < 40; ++col) {
    const double x0 = bed.x_of(col) - 0.01, x1 = bed.x_of(col) + 0.01;
    EXPECT_NEAR(bed(0, col), 0.01 * (std::cos(k * x0) - std::cos(k * x1)) / (k * 0.02), 1e-15);
  }
}

}  // namespace
}  // namespace sandstroke
