#include "rules/slip_surface.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace sandstroke {
namespace {

double tangent(double angle) { return std::tan(angle * std::numbers::pi / 180.0); }

// Chen, Limit Analysis and Soil Plasticity (1975), table 9.1: gamma H / c of cuts below level ground.
TEST(SlipSurface, LogSpiralsHavePublishedHeights) {
  EXPECT_NEAR(critical_height(SlipSurface::spiral, 90.0, 25.0), 6.06, 0.005);
  EXPECT_NEAR(critical_height(SlipSurface::spiral, 60.0, 25.0), 12.74, 0.005);
  EXPECT_NEAR(critical_height(SlipSurface::spiral, 45.0, 25.0), 22.90, 0.005);
}

TEST(SlipSurface, CulmannsPlaneUnderAVerticalCutIsTheTextbooks) {
  for (const double friction : {10.0, 33.0, 50.0})
    EXPECT_NEAR(critical_height(SlipSurface::plane, 90.0, friction), 4.0 * tangent(45.0 + 0.5 * friction),
                1e-12);
}

TEST(SlipSurface, NoPlaneIsWorseThanTheWorstSpiral) {
  for (const double friction : {5.0, 20.0, 33.0, 45.0})
    for (const double face : {90.0, 75.0, 60.0, 50.0})
      EXPECT_LT(critical_height(SlipSurface::spiral, face, friction),
                critical_height(SlipSurface::plane, face, friction))
          << face << " " << friction;
}

/// The height [c / gamma] at which a straight cut fails along some chord from its toe.
double height_by_chords(const CohesionFactor& factor, double face) {
  const double cot_face = face == 90.0 ? 0.0 : 1.0 / tangent(face), mu = factor.friction();
  double least = std::numeric_limits<double>::infinity();
  for (double T = mu * 1.01; T * cot_face < 1.0 && T < 20.0; T += 1e-3)
    least = std::min(least, 2.0 * factor(T, 1.0) * (1.0 + T * T) / ((T - mu) * (1.0 - T * cot_face)));
  return least;
}

TEST(SlipSurface, ChordsGiveTheSurfacesHeights) {
  for (const SlipSurface surface : {SlipSurface::spiral, SlipSurface::plane})
    for (const double friction : {20.0, 33.0, 40.0})
      for (const double face : {90.0, 80.0, 65.0, 55.0}) {
        const double height = critical_height(surface, face, friction);
        EXPECT_NEAR(height_by_chords(CohesionFactor(surface, friction), face) / height, 1.0, 2e-3)
            << face << " " << friction;
      }
}

TEST(SlipSurface, NoWedgeFailsInSandHalfAsHighAsAVerticalCut) {
  for (const SlipSurface surface : {SlipSurface::spiral, SlipSurface::plane})
    for (const double friction : {5.0, 20.0, 33.0, 60.0}) {
      const CohesionFactor factor(surface, friction);
      const double mu = factor.friction();
      EXPECT_NEAR(factor.safe_height() / critical_height(surface, 90.0, friction), 0.5, 0.02);
      // The mean thickness at which a wedge fails that lies on a chord of slope T.
      for (double T = mu * 1.001; T < 50.0; T *= 1.01)
        EXPECT_GE(factor(T, 1.0) * (1.0 + T * T) / (T - mu), factor.safe_height()) << T;
    }
}

}  // namespace
}  // namespace sandstroke
