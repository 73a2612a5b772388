#include "validation/study/planar_stress.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace sandstroke {
namespace {

constexpr double upright = 0.5 * std::numbers::pi;

TEST(PlanarStress, IsOneUnderAFlatPlateInTheGenericMedium) {
  const PlanarStress down = planar_stress(generic_medium, 0.0, upright);
  EXPECT_NEAR(down.up, 1.0, 1e-12);
  EXPECT_NEAR(down.against, 0.0, 1e-12);
}

TEST(PlanarStress, IsTheSumOfTheSeriesOfMeasuredMedia) {
  // N/cm^3: a flat plate pushed down, A00 + A10 + B11 + B01 + B-11; a blade dragged, C01 - C11 - C-11.
  constexpr double pushed[] = {0.254, 0.464, 0.218}, dragged[] = {0.083, 0.107};
  for (std::size_t i = 0; i < measured_media.size(); ++i)
    EXPECT_NEAR(planar_stress(measured_media[i], 0.0, upright).up, pushed[i], 1e-12);
  for (std::size_t i = 0; i < std::size(dragged); ++i)
    EXPECT_NEAR(planar_stress(measured_media[i], upright, 0.0).against, dragged[i], 1e-12);
}

TEST(PlanarStress, IsThatOfAPlateWithoutAFrontSide) {
  // Leaning to either side it is the same to what goes straight down; upright it is the same plate.
  for (const double angle : {0.1, 0.7, 1.2}) {
    const PlanarStress left = planar_stress(generic_medium, angle, upright),
                       right = planar_stress(generic_medium, -angle, upright);
    EXPECT_NEAR(left.up, right.up, 1e-12);
    EXPECT_NEAR(left.against, -right.against, 1e-12);
    const PlanarStress one = planar_stress(generic_medium, upright, angle),
                       other = planar_stress(generic_medium, -upright, angle);
    EXPECT_NEAR(one.up, other.up, 1e-12);
    EXPECT_NEAR(one.against, other.against, 1e-12);
  }
}

TEST(PlanarStress, TakesEnergyFromEveryPlate) {
  // The fit itself is not sure of that where a plate slides along itself: there it is nearly 0.
  for (double tilt = -90.0; tilt <= 90.0; tilt += 15.0)
    for (double dive = -90.0; dive <= 90.0; dive += 15.0) {
      const double along = dive * upright / 90.0;
      const PlanarStress stress = planar_stress(generic_medium, tilt * upright / 90.0, along);
      EXPECT_GT(stress.up * std::sin(along) + stress.against * std::cos(along), -0.05) << tilt << " " << dive;
    }
}

}  // namespace
}  // namespace sandstroke
