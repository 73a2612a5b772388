// How near to their closed forms cuts and towers of moist sand fail, at 80 cells per height.
#include <gtest/gtest.h>

#include "rules/cuts.h"
#include "validation/study/standing_cut.h"

namespace sandstroke {
namespace {

TEST(Cuts, StandToTheSlipSurfacesHeightHoweverTheyAreTurned) {
  for (const double face : {90.0, 75.0, 60.0, 45.0})
    for (const double turn : {0.0, 11.0, 22.5, 45.0})
      for (const double shift : {0.0, 0.3, 0.6}) {
        const double error = height_error({face, cuts::friction_angle, turn, shift, 80}, SlipSurface::spiral);
        EXPECT_LE(error, face == 90.0 ? 0.0075 : 0.025) << face << " " << turn << " " << shift;
        EXPECT_GE(error, -0.0025) << face << " " << turn << " " << shift;
      }
}

TEST(Cuts, ARoundTowerHalfAsWideAsACutIsHighStandsTo88PercentOfIt) {
  const CohesionFactor factor(SlipSurface::plane, cuts::friction_angle);
  const double of_cut = critical_height(SlipSurface::plane, 90.0, cuts::friction_angle);
  EXPECT_NEAR(cuts::height_of_tower(factor, 0.5 * of_cut, of_cut, 80) / of_cut, 0.884, 0.018);
}

}  // namespace
}  // namespace sandstroke
