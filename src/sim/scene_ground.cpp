#include "sim/scene_ground.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "core/error.h"
#include "rules/talus.h"
#include "sand/make_ground.h"
#include "sand/sand_region.h"
#include "sand/stone_surface.h"
#include "sim/floor_force.h"

namespace sandstroke {
namespace {

constexpr double farthest = 1e6, highest = 1000.0;  // m
constexpr std::size_t most_corners = 1000, most_regions = 1000, most_stones = 10'000;

void describe_region(KeyVisitor& v, SandRegion& region) {
  choose(v, "shape", region.shape, {"rectangle", "circle", "polygon"}, "its outline");
  if (region.shape != RegionShape::polygon)
    v.numbers("centre", region.centre.data(), 2, any_number, "m", "its middle");
  if (region.shape == RegionShape::rectangle)
    v.numbers("size", region.size.data(), 2, positive, "m", "extent along x and y");
  if (region.shape == RegionShape::circle) v.number("radius", region.radius, positive, "m", "its radius");
  if (region.shape == RegionShape::polygon) {
    if (v.reads()) v.require("points");
    v.points("points", region.points, "m", "3 or more corners, in order around the outline: [[x, y], ...]");
  }
  v.number("soft", region.soft, not_negative, "m",
           "width of the band around its edge in which the sand's kind changes; 0: a sharp edge");
  if (v.reads()) v.require("talus_angle");
  v.number("talus_angle", region.talus_angle, sharp_angle, "deg",
           "angle of repose of its sand, instead of relaxation.talus_angle");
}

void describe_stone(KeyVisitor& v, StoneSettings& stone) {
  choose(v, "shape", stone.shape, {"sphere", "ellipsoid", "box", "mesh"}, "its shape");
  if (v.reads()) v.require("centre");
  v.numbers("centre", stone.centre.data(), 3, any_number, "m",
            "its middle, or where the origin of a mesh's file is");
  if (stone.shape == StoneShape::sphere) v.number("radius", stone.radius, positive, "m", "its radius");
  if (stone.shape == StoneShape::ellipsoid || stone.shape == StoneShape::box)
    v.numbers("size", stone.size.data(), 3, positive, "m", "full extent along x, y and z");
  if (stone.shape == StoneShape::mesh) {
    v.text("file", stone.file, "a closed surface (.stl), z up, relative to the scene");
    v.number("scale", stone.scale, positive, "m", "length of the file's unit (0.001: millimetres)");
  }
  if (stone.shape != StoneShape::sphere)
    v.number("turn", stone.turn, degrees, "deg", "rotation about z, from +x towards +y");
  v.number("talus_angle", stone.talus_angle, {0.0, 89.9, false}, "deg",
           "angle of repose of the sand that lies on it; 0: as around it");
}

/// The height below which no sand lies at the start [m], if no file has to be read for it.
double lowest_sand(const SurfaceSettings& surface) {
  switch (surface.kind) {
    case SurfaceKind::flat:
    case SurfaceKind::file:
      return 0.0;
    case SurfaceKind::cylinder:
    case SurfaceKind::cone:
    case SurfaceKind::cliff:
      return std::min(0.0, surface.height);
    case SurfaceKind::noise:
    case SurfaceKind::ripples:
      return -surface.amplitude;
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
  if (is_outside(RegionArea(region).bounds(), bed))
    throw_input_error("{}: {} lies outside the bed of {} m by {} m; change {}.{}, or remove it", name, key,
                      bed.width, bed.depth, key, region.shape == RegionShape::polygon ? "points" : "centre");
}

void check_stone(const StoneSettings& stone, const Scene& scene, const std::string& name,
                 const std::string& key) {
  if (stone.shape == StoneShape::mesh && stone.file.empty() && !stone.mesh)
    throw_input_error("{}: {}.file is missing; name a mesh (.stl)", name, key);
  for (const double length : stone.centre.head<2>()) check_length(length, farthest, name, key + ".centre");
  check_length(stone.centre.z(), highest, name, key + ".centre");
  check_length(stone.radius, highest, name, key + ".radius");
  for (const double length : stone.size) check_length(length, highest, name, key + ".size");
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
                        name, key, *law, solid ? solid : "[[sand.region]]");
  if (solid && scene.relaxation.law == RelaxationLaw::paper && takes_super_steps(scene.relaxation.method))
    throw_input_error(
        "{}: relaxation.law = \"paper\" goes with relaxation.method = \"passes\" or \"plain\" where there is "
        "a "
        "{}; take one of them, or another law",
        name, solid);
}

}  // namespace

void describe_floor(KeyVisitor& v, GroundSettings& ground) {
  if (!(v.reads() ? v.given("floor") : ground.floor.has_value())) return;
  double height = ground.floor.value_or(0.0);
  v.number("floor", height, {-highest, highest, false}, "m",
           "height of a level floor under the sand, such as the wood of a box; left out: the sand is as deep "
           "as may be");
  ground.floor = height;
}

void describe_ground(KeyVisitor& v, GroundSettings& ground) {
  show_tables(v, "sand.region", ground.regions,
              "a part of the bed with sand of its own kind, in a [[sand.region]] each; later ones lie over "
              "earlier ones",
              describe_region);
  show_tables(v, "stone", ground.stones,
              "a body on which sand lies and around which it flows, in a [[stone]] each (stone.2.radius is "
              "that of the second); only its upper side counts",
              describe_stone);
  if (!ground.is_solid()) return;
  v.section("ground", "stones, and the floor of bed.floor");
  v.number("stiffness", ground.stiffness, not_negative, "N/m",
           "of stones and floor under the hand; 0: it does not feel them");
}

void check_ground(const Scene& scene, const std::string& name) {
  const GroundSettings& ground = scene.ground;
  if (ground.empty()) return;
  check_list(ground.regions, most_regions, "sand.region", name);
  check_list(ground.stones, most_stones, "stone", name);
  for (std::size_t i = 0; i < ground.regions.size(); ++i)
    check_region(ground.regions[i], scene.bed, name, fmt::format("sand.region.{}", i + 1));
  for (std::size_t i = 0; i < ground.stones.size(); ++i)
    check_stone(ground.stones[i], scene, name, fmt::format("stone.{}", i + 1));
  check_laws(scene, name);
  check_floor_stiffness(scene, name);
}

double memory_of_ground(const Scene& scene) {
  if (scene.ground.empty()) return 0.0;
  const BedSettings& bed = scene.bed;
  const BedGeometry geometry(bed.rows, bed.cols, bed.cell_size());
  const GroundTiles tiles = most_tiles(geometry, scene.ground);
  const bool lifts_all = scene.ground.floor && *scene.ground.floor > lowest_sand(bed.surface);
  const double lifted = lifts_all ? geometry.tile_count() : tiles.floor;
  return static_cast<double>(HeightField::bytes_per_tile()) * (tiles.floor + tiles.slopes) +
         static_cast<double>(bytes_per_relaxed_tile(scene.relaxation, true)) * lifted;
}

HeightField on_ground(HeightField bed, const Scene& scene) {
  if (!scene.ground.empty())
    bed.lie_on(make_ground(bed, scene.ground, talus_slope(scene.relaxation.talus_angle)));
  return bed;
}

}  // namespace sandstroke
