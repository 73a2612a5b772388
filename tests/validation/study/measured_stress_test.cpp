#include "validation/study/measured_stress.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>

namespace sandstroke {
namespace {

constexpr double right_angle = 0.5 * std::numbers::pi;

TEST(LawStress, IsThatOfTheTheorysTwoPlates) {
  EXPECT_NEAR(law_stress(0.0, right_angle).up, 0.87574, 1e-9);
  EXPECT_NEAR(law_stress(0.0, right_angle).against, 0.0, 1e-9);
  EXPECT_NEAR(law_stress(right_angle, 0.0).against, 0.192, 5e-4);
}

TEST(LawStress, IsTheSameStraightDownForAPlateThatLeansToEitherSide) {
  for (const double angle : {0.1, 0.7, 1.2}) {
    const PlanarStress left = law_stress(angle, right_angle), right = law_stress(-angle, right_angle);
    EXPECT_NEAR(left.up, right.up, 1e-12);
    EXPECT_NEAR(left.against, -right.against, 1e-12);
  }
}

TEST(StressPlots, ShowEveryTiltByBothTheoriesAndAsMeasured) {
  const std::vector<Plot> plots = stress_plots();
  for (const Plot& plot : plots) {
    std::set<std::string> tilts;
    for (const Plot::Curve& curve : plot.curves) {
      tilts.insert(curve.name);
      EXPECT_EQ(curve.x.size(), curve.y.size());
      for (const double y : curve.y) EXPECT_TRUE(std::isfinite(y)) << curve.name;
    }
    EXPECT_EQ(plot.curves.size(), 3 * tilts.size());
  }
  // All in units of the same plate.
  for (const Plot::Curve& curve : plots[0].curves)
    if (curve.name.starts_with("tilt 0")) {
      EXPECT_NEAR(curve.y.back(), 1.0, 1e-9);
    }
}

TEST(MeasuredStresses, HaveSourcesAndNumbers) {
  const std::vector<MeasuredFigure> rows = measured_stresses();
  ASSERT_GT(rows.size(), 1u);
  EXPECT_NEAR(rows[0].model / rows[0].measured, 1.05, 0.01);  // Quikrete: 2.13 of 2.02 N/cm^3
  for (const MeasuredFigure& row : rows) {
    EXPECT_FALSE(row.source.empty());
    EXPECT_TRUE(std::isfinite(row.measured) && std::isfinite(row.model)) << row.what;
  }
}

}  // namespace
}  // namespace sandstroke
