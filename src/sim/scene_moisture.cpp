#include "sim/scene_moisture.h"

#include <algorithm>
#include <limits>

#include "core/error.h"
#include "rules/force.h"
#include "rules/talus.h"
#include "sand/region_values.h"
#include "sim/plugin_laws.h"

namespace sandstroke {
namespace {

double friction_angle(const Scene& scene) {
  const double own = scene.moisture->friction_angle;
  return own > 0.0 ? own : scene.relaxation.talus_angle;
}

/// The cohesion over the weight per volume [m]. region: null for the scene's own sand.
double cohesion_over_weight(const Scene& scene, const SandRegion* region) {
  const double own = scene.moisture->cohesion, density = scene.strength.density;
  return (region ? region->cohesion.value_or(own) : own) /
         ((region ? region->density.value_or(density) : density) * gravity);
}

/// The first region with a cohesion of its own, counted from 1; 0: none has.
int cohesive_region(const Scene& scene) {
  const std::vector<SandRegion>& regions = scene.ground.regions;
  for (std::size_t i = 0; i < regions.size(); ++i)
    if (regions[i].cohesion) return static_cast<int>(i) + 1;
  return 0;
}

/// The cohesion over the weight per volume, by place where regions have their own of either.
Cohesion cohesion_of(const Scene& scene, const BedGeometry& bed) {
  const double own = cohesion_over_weight(scene, nullptr), cohesion_there = scene.moisture->cohesion,
               density_there = scene.strength.density;
  Cohesion cohesion{own};
  const auto values_of = [&](const RegionValues::ValueOf& value_of) {
    return RegionValues(scene.ground.regions, value_of, bed.cell_size());
  };
  const RegionValues cohesions = values_of([](const SandRegion& region) { return region.cohesion; });
  const RegionValues densities = values_of([](const SandRegion& region) { return region.density; });
  if (cohesions.empty() && densities.empty()) return cohesion;
  auto by_place = std::make_shared<HeightField>(bed.rows(), bed.cols(), bed.cell_size(),
                                                std::make_shared<LevelRule>(own));
  for (int row = 0; row < bed.rows(); ++row)
    for (int col = 0; col < bed.cols(); ++col) {
      const Eigen::Vector2d place(bed.x_of(col), bed.y_of(row));
      const double there =
          cohesions.at(place, cohesion_there) / (densities.at(place, density_there) * gravity);
      if (there == own) continue;
      by_place->set(row, col, there);
      cohesion.least = std::min(cohesion.least, there);
    }
  cohesion.by_place = std::move(by_place);
  return cohesion;
}

}  // namespace

void describe_moisture(KeyVisitor& v, std::optional<MoistureSettings>& moisture) {
  if (!v.optional_section("moisture", moisture.has_value(),
                          "moist sand: cuts stand up to a height, and fail as wedges beyond; without it the "
                          "sand is dry"))
    return;
  if (!moisture) moisture.emplace();
  MoistureSettings& m = *moisture;
  if (v.reads()) v.require("cohesion");
  v.number(
      "cohesion", m.cohesion, {0.0, most_cohesion, false}, "Pa",
      "what holds moist sand together, from a shear test: 150 for damp, 600 for well mixed sand; 0: dry. "
      "The force on the tool knows none");
  v.number("friction_angle", m.friction_angle, {0.0, friction_angles.highest, false}, "deg",
           "angle of internal friction of intact sand; 0: relaxation.talus_angle");
  choose(v, "surface", m.surface, {std::begin(slip_surface_names), std::end(slip_surface_names)},
         "along which it fails: log-spirals, or planes (Culmann), which let slanting cuts stand too high");
  v.flag("heals", m.heals, "sand that has come to rest is intact again");
  v.number("dries", m.dries, not_negative, "Pa/s", "cohesion that the sand loses as time passes");
}

void check_moisture(const Scene& scene, const std::string& name) {
  if (!scene.moisture) {
    if (const int region = cohesive_region(scene))
      throw_input_error(
          "{}: sand.region.{}.cohesion applies only where there is a [moisture]; add that section, or remove "
          "the key",
          name, region);
    return;
  }
  if (!scene.plugin_laws.relaxation.empty())
    throw_input_error(
        "{}: [moisture] does not know how the plugin law model.relaxation = \"{}\" moves sand; "
        "remove one of the two",
        name, scene.plugin_laws.relaxation);
  if (scene.relaxation.law == RelaxationLaw::paper)
    throw_input_error(
        "{}: [moisture] does not go with relaxation.law = \"paper\", which knows no floor in super-steps; "
        "take \"isotropic\" or \"faces\", or model.preset = \"accurate\"",
        name);
  if (!friction_angles.contains(friction_angle(scene)))
    throw_input_error(
        "{}: moist sand has a friction angle of {:g} deg{}; give moisture.friction_angle from {:g} to {:g}",
        name, friction_angle(scene), scene.moisture->friction_angle > 0.0 ? "" : " (relaxation.talus_angle)",
        friction_angles.lowest, friction_angles.highest);
  if (scene.moisture->dries > 0.0 && scene.only_relaxes())
    throw_input_error(
        "{}: moisture.dries needs time, and none passes in a scene without [stroke] and [[source]]; add "
        "one, or set a lower moisture.cohesion",
        name);
}

bool is_moist(const Scene& scene) {
  if (!scene.moisture) return false;
  const std::vector<SandRegion>& regions = scene.ground.regions;
  return scene.moisture->cohesion > 0.0 ||
         std::any_of(regions.begin(), regions.end(),
                     [](const auto& region) { return region.cohesion.value_or(0.0) > 0.0; });
}

double slope_of_crumbs(const Scene& scene) {
  return is_moist(scene) ? talus_slope(scene.relaxation.talus_angle) : 0.0;
}

std::string coarse_moisture_warning(const Scene& scene) {
  if (!is_moist(scene)) return "";
  const MoistureSettings& moisture = *scene.moisture;
  // Of the sand whose cuts stand lowest.
  double least = std::numeric_limits<double>::infinity();
  std::string key = "moisture.cohesion";
  if (moisture.cohesion > 0.0) least = cohesion_over_weight(scene, nullptr);
  for (std::size_t i = 0; i < scene.ground.regions.size(); ++i) {
    const double there = cohesion_over_weight(scene, &scene.ground.regions[i]);
    if (!(there > 0.0 && there < least)) continue;
    least = there;
    if (scene.ground.regions[i].cohesion) key = fmt::format("sand.region.{}.cohesion", i + 1);
  }
  constexpr double most_error = 0.05;  // of the height; 0.51 over its cells is the error of a cut
  const double height = critical_height(moisture.surface, 90.0, friction_angle(scene)) * least,
               cells = height / scene.bed.cell_size(), error = 0.51 / cells;
  if (error <= most_error) return "";
  return fmt::format(
      "a vertical cut of this moist sand stands {:.3g} mm high, which are {:.2g} cells: it stands up "
      "to {:.0f} % too high, and with one cell or less the sand lies as if dry; take cells of {:.2g} mm, "
      "or more {}",
      1e3 * height, cells, 100.0 * error, 1e3 * height * most_error / 0.51, key);
}

std::unique_ptr<Relaxer> make_relaxer(const Scene& scene, const HeightField& bed) {
  std::unique_ptr<Relaxer> flow = make_relaxer(scene, bed.cell_size());
  if (!is_moist(scene)) return flow;
  const MoistureSettings& moisture = *scene.moisture;
  return make_standing_relaxer(std::move(flow), bed,
                               {CohesionFactor(moisture.surface, friction_angle(scene)),
                                cohesion_of(scene, bed), moisture.dries / (scene.strength.density * gravity),
                                moisture.heals, talus_slope(scene.relaxation.talus_angle)});
}

}  // namespace sandstroke
