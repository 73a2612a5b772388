#include "validation/study/planar_stress.h"

#include <cmath>
#include <limits>

namespace sandstroke {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

}  // namespace

const PlanarMedium generic_medium = {"generic", 0.206,  0.169, 0.212, 0.358,
                                     0.055,     -0.124, 0.253, 0.007, 0.088};

const std::vector<PlanarMedium> measured_media = {
    {"poppy seeds, loosely packed", 0.051, 0.047, 0.053, 0.083, 0.020, -0.026, 0.057, 0.000, 0.025},
    {"poppy seeds, closely packed", 0.094, 0.092, 0.092, 0.151, 0.035, -0.039, 0.086, 0.018, 0.046},
    {"glass spheres of 3 mm, closely packed", 0.045, 0.031, 0.046, 0.084, 0.012, unknown, unknown, unknown,
     unknown},
};

PlanarStress planar_stress(const PlanarMedium& medium, double tilt, double dive) {
  const double turned = 2.0 * tilt;
  return {medium.a00 + medium.a10 * std::cos(turned) + medium.b11 * std::sin(turned + dive) +
              medium.b01 * std::sin(dive) + medium.b_11 * std::sin(-turned + dive),
          medium.c11 * std::cos(turned + dive) + medium.c01 * std::cos(dive) +
              medium.c_11 * std::cos(-turned + dive) + medium.d10 * std::sin(turned)};
}

}  // namespace sandstroke
