#include "sim/check_ground.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>

#include "core/error.h"
#include "sand/sand_region.h"
#include "sand/stone_surface.h"
#include "sim/floor_force.h"
#include "sim/scene_sand_map.h"

namespace sandstroke {
namespace {

constexpr double farthest = 1e6, most_height = 1000.0;  // m
constexpr std::size_t most_corners = 1000, most_regions = 1000, most_layers = 100, most_stones = 10'000;

/// The height above which no sand lies at the start [m], if no file has to be read for it.
double highest_sand(const SurfaceSettings& surface) {
  switch (surface.kind) {
    case SurfaceKind::flat:
      return 0.0;
    case SurfaceKind::file:
      return std::numeric_limits<double>::infinity();
    case SurfaceKind::cylinder:
    case SurfaceKind::cone:
    case SurfaceKind::cliff:
      return std::max(0.0, surface.height);
    case SurfaceKind::noise:
    case SurfaceKind::ripples:
      return surface.amplitude;
  }
  return 0.0;
}

/// Error: input, if a length [m] of `key` is too large to reckon with.
void check_length(double length, double most, const std::string& name, const std::string& key) {
  if (!(std::abs(length) <= most))
    throw_input_error("{}: {} has {:g} m; give {:g} m or less", name, key, length, most);
}

/// Whether a box [m] lies outside the bed.
bool is_outside(const Eigen::AlignedBox2d& box, const BedSettings& bed) {
  const Eigen::Vector2d half = 0.5 * Eigen::Vector2d(bed.width, bed.depth);
  return box.intersection(Eigen::AlignedBox2d(-half, half)).isEmpty();
}

void check_polygon(const std::vector<Eigen::Vector2d>& points, const std::string& name,
                   const std::string& key) {
  std::set<std::array<double, 2>> different;
  for (const Eigen::Vector2d& point : points) {
    different.insert({point.x(), point.y()});
    for (const double length : point) check_length(length, farthest, name, key + ".points");
  }
  if (different.size() < 3)
    throw_input_error("{}: {}.points has {} different {}; give 3 or more", name, key, different.size(),
                      different.size() == 1 ? "corner" : "corners");
  if (points.size() > most_corners)
    throw_input_error("{}: {}.points has {} corners; give {} or fewer", name, key, points.size(),
                      most_corners);
  if (crosses_itself(points))
    throw_input_error("{}: {}.points has edges that cross; give the corners in order around the outline",
                      name, key);
}

void check_region(const SandRegion& region, const BedSettings& bed, const std::string& name,
                  const std::string& key) {
  if (region.shape == RegionShape::polygon) check_polygon(region.points, name, key);
  for (const double length : region.centre) check_length(length, farthest, name, key + ".centre");
  for (const double length : region.size) check_length(length, farthest, name, key + ".size");
  check_length(region.radius, farthest, name, key + ".radius");
  check_length(region.soft, farthest, name, key + ".soft");
  if (!region.talus_angle && !region.friction_angle && !region.density && !region.k_s && !region.cohesion)
    throw_input_error(
        "{}: {} says nothing of its sand; give it a talus_angle, friction_angle, density, k_s or cohesion",
        name, key);
  if (is_outside(RegionArea(region).bounds(), bed))
    throw_input_error("{}: {} lies outside the bed of {} m by {} m; change {}.{}, or remove it", name, key,
                      bed.width, bed.depth, key, region.shape == RegionShape::polygon ? "points" : "centre");
}

void check_layer(std::size_t place, const Scene& scene, const std::string& name) {
  const std::vector<SandLayer>& layers = scene.ground.layers;
  const SandLayer& layer = layers[place];
  const std::string key = fmt::format("sand.layer.{}", place + 1);
  if (!layer.friction_angle && !layer.density)
    throw_input_error("{}: {} says nothing of its sand; give it a friction_angle or density", name, key);
  for (std::size_t i = 0; i < place; ++i)
    if (layers[i].top == layer.top)
      throw_input_error("{}: sand.layer.{}.top and {}.top are both {:g} m; change one of them", name, i + 1,
                        key, layer.top);
  if (layer.top >= highest_sand(scene.bed.surface))
    throw_input_error(
        "{}: {}.top = {:g} m is not below the sand, whose highest is at {:g} m; z is up, so {:g} m below "
        "level "
        "sand is {:g}",
        name, key, layer.top, highest_sand(scene.bed.surface), std::abs(layer.top), -std::abs(layer.top));
  if (scene.ground.floor && layer.top <= *scene.ground.floor)
    throw_input_error("{}: {}.top = {:g} m is not above bed.floor = {:g} m; change one of them", name, key,
                      layer.top, *scene.ground.floor);
}

void check_stone(const StoneSettings& stone, const Scene& scene, const std::string& name,
                 const std::string& key) {
  if (stone.shape == StoneShape::mesh && stone.file.empty() && !stone.mesh)
    throw_input_error("{}: {}.file is missing; name a mesh (.stl)", name, key);
  for (const double length : stone.centre.head<2>()) check_length(length, farthest, name, key + ".centre");
  check_length(stone.centre.z(), most_height, name, key + ".centre");
  check_length(stone.radius, most_height, name, key + ".radius");
  for (const double length : stone.size) check_length(length, most_height, name, key + ".size");
  if (stone.shape == StoneShape::mesh && !stone.mesh) return;
  const Eigen::AlignedBox3d box = StoneSurface(stone).bounds();
  if (is_outside({box.min().head<2>(), box.max().head<2>()}, scene.bed))
    throw_input_error("{}: {} lies outside the bed of {} m by {} m; change {}.centre, or remove it", name,
                      key, scene.bed.width, scene.bed.depth, key);
  const std::optional<double>& floor = scene.ground.floor;
  if (floor && box.max().z() <= *floor)
    throw_input_error(
        "{}: {} ends at z = {:g} m, and bed.floor = {:g} m is not below that; raise the stone, "
        "or remove it",
        name, key, box.max().z(), *floor);
}

/// Error: input, if two of them are equal, or if they are more than `most`.
template <class Settings>
void check_list(const std::vector<Settings>& list, std::size_t most, const char* key,
                const std::string& name) {
  if (list.size() > most)
    throw_input_error("{}: has {} [[{}]] tables; give {} or fewer", name, list.size(), key, most);
  for (std::size_t i = 0; i < list.size(); ++i)
    for (std::size_t k = 0; k < i; ++k)
      if (list[i] == list[k])
        throw_input_error("{}: {}.{} is the same as {}.{}; remove one of them", name, key, i + 1, key, k + 1);
}

void check_laws(const Scene& scene, const std::string& name) {
  const char* solid = scene.ground.floor ? "bed.floor" : !scene.ground.stones.empty() ? "[[stone]]" : nullptr;
  const PluginLawSettings& own = scene.plugin_laws;
  for (const auto& [key, law] :
       {std::pair("relaxation", &own.relaxation), std::pair("displacement", &own.displacement),
        std::pair("force", &own.force)})
    if (!law->empty())
      throw_input_error("{}: model.{} = \"{}\" is a plugin law, which knows no {}; remove one of the two",
                        name, key, *law,
                        solid                          ? solid
                        : scene.ground.map             ? "[sand.map]"
                        : scene.ground.regions.empty() ? "[[sand.layer]]"
                                                       : "[[sand.region]]");
  if (solid && scene.relaxation.law == RelaxationLaw::paper && takes_super_steps(scene.relaxation.method))
    throw_input_error(
        "{}: relaxation.law = \"paper\" goes with relaxation.method = \"passes\" or \"plain\" where there is "
        "a "
        "{}; take one of them, or another law",
        name, solid);
}

/// Error: input, for a number of the force that its law does not know.
void check_strengths(const Scene& scene, const std::string& name) {
  const std::string& plugin = scene.plugin_laws.force;
  const bool paper = plugin.empty() && scene.force.law == ForceLaw::paper, contact = plugin.empty() && !paper;
  const auto check = [&](const std::string& table, const char* key, const std::optional<double>& value,
                         bool counts, const char* laws) {
    if (value && !counts)
      throw_input_error("{}: {}.{} counts only with {}; take that law, or remove it", name, table, key, laws);
  };
  constexpr const char *by_paper = "force.law = \"paper\"",
                       *by_contact = "force.law = \"rft\" or \"archimedes\"";
  // weighs: where something else but the force knows the density, too.
  const auto check_both = [&](const std::string& table, const auto& sand, bool weighs) {
    check(table, "friction_angle", sand.friction_angle, contact, by_contact);
    check(table, "density", sand.density, contact || weighs, by_contact);
  };
  const GroundSettings& ground = scene.ground;
  if (scene.strength.blend > 0.0 && !(paper ? ground.has_k_s() : contact && ground.has_strengths()))
    throw_input_error(
        "{}: force.blend = {:g} m counts only where a [[sand.region]] or [[sand.layer]] gives the force "
        "another sand; remove it",
        name, scene.strength.blend);
  constexpr double least_blend = 1e-6;  // m: below it a border is a step
  if (scene.strength.blend > 0.0 && scene.strength.blend < least_blend)
    throw_input_error("{}: force.blend = {:g} m is too small; give {:g} m or more, or 0 for the tool's width",
                      name, scene.strength.blend, least_blend);
  for (std::size_t i = 0; i < ground.regions.size(); ++i) {
    const std::string table = fmt::format("sand.region.{}", i + 1);
    check_both(table, ground.regions[i], scene.moisture.has_value());
    check(table, "k_s", ground.regions[i].k_s, paper, by_paper);
  }
  for (std::size_t i = 0; i < ground.layers.size(); ++i)
    check_both(fmt::format("sand.layer.{}", i + 1), ground.layers[i], false);
}

}  // namespace

void check_ground(const Scene& scene, const std::string& name) {
  check_strengths(scene, name);
  const GroundSettings& ground = scene.ground;
  if (ground.empty()) return;
  if (ground.map) check_sand_map(*ground.map, name);
  check_list(ground.regions, most_regions, "sand.region", name);
  check_list(ground.layers, most_layers, "sand.layer", name);
  check_list(ground.stones, most_stones, "stone", name);
  for (std::size_t i = 0; i < ground.regions.size(); ++i)
    check_region(ground.regions[i], scene.bed, name, fmt::format("sand.region.{}", i + 1));
  for (std::size_t i = 0; i < ground.layers.size(); ++i) check_layer(i, scene, name);
  for (std::size_t i = 0; i < ground.stones.size(); ++i)
    check_stone(ground.stones[i], scene, name, fmt::format("stone.{}", i + 1));
  check_laws(scene, name);
  check_floor_stiffness(scene, name);
}

}  // namespace sandstroke
