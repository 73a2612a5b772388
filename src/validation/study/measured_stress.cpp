#include "validation/study/measured_stress.h"

#include <spdlog/fmt/fmt.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "core/angle.h"
#include "sand/resistive_force.h"

namespace sandstroke {
namespace {

using PlateStress = std::function<PlanarStress(double tilt, double dive)>;

constexpr double straight_down = 90.0;  // deg

PlateStress stress_in(const PlanarMedium& medium) {
  return [&medium](double tilt, double dive) { return planar_stress(medium, tilt, dive); };
}

/// The stress in units of a flat plate's that is pushed straight down. Angles in deg.
PlanarStress relative(const PlateStress& stress, double tilt, double dive) {
  const double unit = stress(0.0, to_radians(straight_down)).up;
  const PlanarStress found = stress(to_radians(tilt), to_radians(dive));
  return {found.up / unit, found.against / unit};
}

Plot stress_plot(const char* title, double PlanarStress::*part) {
  Plot plot{title,
            "In units of a flat plate pushed straight down. A plate tilted by 90° is a blade; one by "
            "-45° "
            "leans back, over the sand behind it.",
            "direction of motion below the horizontal",
            "°",
            "stress over depth, relative",
            {},
            {{Plot::Look::line, "the program's law: 3D-RFT (Agarwal, Goldman, Kamrin 2023)"},
             {Plot::Look::dashed, "2D-RFT, generic coefficients (Li, Zhang, Goldman 2013)"},
             {Plot::Look::points, measured_media[1].name + std::string(", measured (the same)")}}};
  const auto add = [&](double tilt, Plot::Look look, const PlateStress& stress, double step) {
    Plot::Curve curve{fmt::format("tilt {:.0f}°", tilt), look, {}, {}};
    for (double dive = -90.0; dive <= 90.0; dive += step) {
      curve.x.push_back(dive);
      curve.y.push_back(relative(stress, tilt, dive).*part);
    }
    plot.curves.push_back(std::move(curve));
  };
  for (const double tilt : {-45.0, 0.0, 45.0, 90.0}) {
    add(tilt, Plot::Look::line, law_stress, 2.5);
    add(tilt, Plot::Look::dashed, stress_in(generic_medium), 2.5);
    add(tilt, Plot::Look::points, stress_in(measured_media[1]), 30.0);
  }
  return plot;
}

/// A plate's tilt and motion [deg], and the part of its stress to compare.
struct Motion {
  const char* what;
  double tilt, dive;
  double PlanarStress::*part;
};

const std::vector<Motion> motions = {
    {"blade dragged face on: against the motion", 90.0, 0.0, &PlanarStress::against},
    {"plate tilted by 45°, pushed down: upwards", 45.0, straight_down, &PlanarStress::up},
    {"plate tilted by 45°, pushed down: sideways", 45.0, straight_down, &PlanarStress::against},
    {"plate tilted by 45°, dragged: against the motion", 45.0, 0.0, &PlanarStress::against},
    {"plate tilted by 45°, dragged: upwards", 45.0, 0.0, &PlanarStress::up},
    {"flat plate pulled up: upwards", 0.0, -straight_down, &PlanarStress::up},
};

}  // namespace

PlanarStress law_stress(double tilt, double dive) {
  const Eigen::Vector3d motion(std::cos(dive), 0.0, -std::sin(dive));
  Eigen::Vector3d normal(std::sin(tilt), 0.0, -std::cos(tilt));
  if (normal.dot(motion) < 0.0) normal = -normal;
  const Eigen::Vector3d stress = resistive_stress(normal, motion, SandStrength{}.tool_friction);
  return {stress.z(), -stress.x()};
}

std::vector<Plot> stress_plots() {
  return {stress_plot("Vertical stress of the law", &PlanarStress::up),
          stress_plot("Horizontal stress of the law, against the motion", &PlanarStress::against)};
}

std::vector<MeasuredFigure> measured_stresses() {
  SandStrength quikrete;
  quikrete.preset = SandPreset::quikrete;
  apply_sand_preset(quikrete);
  const double flat = law_stress(0.0, to_radians(straight_down)).up;
  std::vector<MeasuredFigure> rows = {
      {fmt::format("Quikrete sand ({:.0f}°, {:.0f} kg/m³)", quikrete.friction_angle, quikrete.density),
       "flat plate pushed down: upwards, N/cm³", 2.02, 1e-6 * flat * resistance(quikrete),
       "Agarwal et al. 2023"}};
  for (const Motion& motion : motions)
    for (const PlanarMedium& medium : measured_media) {
      const double measured = relative(stress_in(medium), motion.tilt, motion.dive).*motion.part;
      if (std::isnan(measured)) continue;
      rows.push_back({medium.name, motion.what, measured,
                      relative(law_stress, motion.tilt, motion.dive).*motion.part,
                      "Li et al. 2013, table S2"});
    }
  return rows;
}

}  // namespace sandstroke
