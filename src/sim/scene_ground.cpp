#include "sim/scene_ground.h"

#include <algorithm>
#include <limits>

#include "rules/talus.h"
#include "sand/make_ground.h"
#include "sim/scene_sand_map.h"
#include "tool/tool_width.h"

namespace sandstroke {
namespace {

constexpr double highest = 1000.0;  // m

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
  show_if_given(v, "talus_angle", region.talus_angle, sharp_angle, "deg",
                "angle of repose of its sand, instead of relaxation.talus_angle");
  show_if_given(v, "friction_angle", region.friction_angle, friction_angles, "deg",
                "its sand's internal friction, instead of force.friction_angle");
  show_if_given(v, "density", region.density, positive, "kg/m^3",
                "its sand's bulk density, instead of force.density: under the tool, and of moist sand");
  show_if_given(v, "k_s", region.k_s, not_negative, "N", "instead of force.k_s");
  show_if_given(v, "cohesion", region.cohesion, {0.0, most_cohesion, false}, "Pa",
                "instead of moisture.cohesion");
}

void describe_layer(KeyVisitor& v, SandLayer& layer) {
  if (v.reads()) v.require("top");
  v.number("top", layer.top, {-highest, highest, false}, "m", "height of the level plane below which it is");
  show_if_given(v, "friction_angle", layer.friction_angle, friction_angles, "deg",
                "its internal friction, instead of force.friction_angle");
  show_if_given(v, "density", layer.density, positive, "kg/m^3",
                "its bulk density, instead of force.density");
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

}  // namespace

void describe_floor(KeyVisitor& v, GroundSettings& ground) {
  show_if_given(
      v, "floor", ground.floor, {-highest, highest, false}, "m",
      "height of a level floor under the sand, such as the wood of a box; left out: the sand is as deep "
      "as may be");
}

void describe_ground(KeyVisitor& v, GroundSettings& ground) {
  describe_sand_map(v, ground.map);
  show_tables(v, "sand.region", ground.regions,
              "a part of the bed with sand of its own kind, in a [[sand.region]] each; later ones lie over "
              "earlier ones",
              describe_region);
  show_tables(
      v, "sand.layer", ground.layers,
      "sand of another kind below a level plane, in a [[sand.layer]] each, which force.law = \"rft\" or "
      "\"archimedes\" feels; the plane stays where it is, and sand keeps its angle of repose",
      describe_layer);
  show_tables(v, "stone", ground.stones,
              "a body on which sand lies and around which it flows, in a [[stone]] each (stone.2.radius is "
              "that of the second); only its upper side counts",
              describe_stone);
  if (!ground.is_solid()) return;
  v.section("ground", "stones, and the floor of bed.floor");
  v.number("stiffness", ground.stiffness, not_negative, "N/m",
           "of stones and floor under the hand; 0: it does not feel them");
}

double strength_blend(const Scene& scene) {
  return scene.strength.blend > 0.0 ? scene.strength.blend
                                    : narrowest_width(scene.tool, std::numeric_limits<double>::infinity());
}

double memory_of_ground(const Scene& scene) {
  if (scene.ground.empty()) return 0.0;
  const BedSettings& bed = scene.bed;
  const BedGeometry geometry(bed.rows, bed.cols, bed.cell_size());
  const GroundTiles tiles = most_tiles(geometry, scene.ground);
  const bool lifts_all = scene.ground.floor && *scene.ground.floor > lowest_sand(bed.surface);
  const double lifted = lifts_all ? geometry.tile_count() : tiles.floor;
  const double map = scene.ground.map ? static_cast<double>(sizeof(double)) * bed.rows * bed.cols : 0.0;
  return map + static_cast<double>(HeightField::bytes_per_tile()) * (tiles.floor + tiles.slopes) +
         static_cast<double>(bytes_per_relaxed_tile(scene.relaxation, true)) * lifted;
}

HeightField on_ground(HeightField bed, const Scene& scene) {
  if (!scene.ground.empty())
    bed.lie_on(make_ground(bed, scene.ground, talus_slope(scene.relaxation.talus_angle)));
  return bed;
}

}  // namespace sandstroke
