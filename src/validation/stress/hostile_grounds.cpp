#include "validation/stress/hostile_grounds.h"

namespace sandstroke {

StoneSettings stone_of(StoneShape shape, const Eigen::Vector3d& centre, const Eigen::Vector3d& size,
                       double talus_angle, double turn) {
  StoneSettings stone;
  stone.shape = shape;
  stone.centre = centre;
  stone.radius = 0.5 * size.x();
  stone.size = size;
  stone.talus_angle = talus_angle;
  stone.turn = turn;
  return stone;
}

SandRegion rectangle_of(const Eigen::Vector2d& centre, const Eigen::Vector2d& size, double talus_angle,
                        double soft) {
  SandRegion region;
  region.centre = centre;
  region.size = size;
  region.talus_angle = talus_angle;
  region.soft = soft;
  return region;
}

SurfaceSettings heap_of(double height) {
  SurfaceSettings surface;
  surface.kind = SurfaceKind::cylinder;
  surface.radius = 0.03;
  surface.height = height;
  return surface;
}

namespace {

SurfaceSettings noise_of(double amplitude) {
  SurfaceSettings surface;
  surface.kind = SurfaceKind::noise;
  surface.amplitude = amplitude;
  surface.wavelength = 0.0;
  return surface;
}

/// Sand of 1 and of 89 degrees in turn, each `width` cells wide.
GroundSettings stripes(int width) {
  GroundSettings ground;
  for (int col = 0; col < ground_cols; col += 2 * width)
    ground.regions.push_back(rectangle_of({(col + 0.5 * width - 0.5 * ground_cols) * ground_cell, 0.0},
                                          {width * ground_cell, 1.0}, 89.0));
  ground.regions.insert(ground.regions.begin(), rectangle_of({0.0, 0.0}, {1.0, 1.0}, 1.0));
  return ground;
}

}  // namespace

std::vector<HostileGround> hostile_grounds() {
  using enum StoneShape;
  using V = Eigen::Vector3d;
  const SurfaceSettings heap = heap_of(0.05), flat;
  std::vector<HostileGround> all;
  const auto stones = [&](const char* name, const char* settings, const SurfaceSettings& surface,
                          std::vector<StoneSettings> list, double spread = 0.0) {
    GroundSettings ground;
    ground.stones = std::move(list);
    all.push_back({name, settings, surface, std::move(ground), spread});
  };
  const auto floor = [&](const char* name, const char* settings, const SurfaceSettings& surface, double at,
                         double spread = 0.0) {
    GroundSettings ground;
    ground.floor = at;
    all.push_back({name, settings, surface, std::move(ground), spread});
  };
  const auto regions = [&](const char* name, const char* settings, GroundSettings ground) {
    all.push_back({name, settings, noise_of(0.02), std::move(ground)});
  };

  stones("stones in one another", "spheres, a box and an ellipsoid about one place", heap,
         {stone_of(sphere, V(0.0, 0.0, 0.0), V::Constant(0.06)),
          stone_of(sphere, V(0.01, 0.0, 0.01), V::Constant(0.05), 89.0),
          stone_of(sphere, V(0.01, 0.0, 0.01), V::Constant(0.04), 1.0),
          stone_of(box, V(0.0, 0.02, 0.0), V(0.03, 0.03, 0.09), 10.0, 33.0),
          stone_of(ellipsoid, V(-0.02, 0.0, 0.0), V(0.1, 0.01, 0.1))});
  stones("a stone larger than the bed", "a sphere of 1 m, and a box of 10 m", heap,
         {stone_of(sphere, V(0.3, 0.2, -0.95), V::Constant(2.0)),
          stone_of(box, V(0.0, 0.0, -5.001), V::Constant(10.0))});
  stones("needles", "1 um to a tenth of a ground_cell wide, 1 mm to 1 km tall", heap,
         {stone_of(box, V(0.0, 0.0, 0.05), V(1e-6, 1e-6, 0.1)),
          stone_of(box, V(0.5 * ground_cell, 0.5 * ground_cell, 0.05), V(1e-4, 1e-4, 0.2)),
          stone_of(ellipsoid, V(0.011, 0.011, 0.0), V(2e-4, 2e-4, 1e3)),
          stone_of(sphere, V(-0.011, 0.011, 0.0), V::Constant(1e-3)),
          stone_of(box, V(0.02, 0.0, 0.0), V(1e-9, 0.05, 0.05))});
  stones("boxes on the edges of cells", "20 cells, also turned by 90 and 180 degrees", heap,
         {stone_of(box, V(0.0, 0.0, 0.0), V(20 * ground_cell, 20 * ground_cell, 0.04)),
          stone_of(box, V(0.02, 0.02, 0.0), V(10 * ground_cell, 20 * ground_cell, 0.06), 0.0, 90.0),
          stone_of(box, V(-0.02, 0.02, 0.0), V(10 * ground_cell, 20 * ground_cell, 0.06), 89.9, 180.0)});
  const StoneSettings needle = stone_of(ellipsoid, V(0.0, 0.0, -0.01), V(0.04, 0.04, 1.0));
  const StoneSettings ball = stone_of(sphere, V(0.04, 0.0, 0.0), V::Constant(0.03));
  stones("steep stones under next to nothing", "flanks of up to 89.9 degrees, under 1 nm of sand", flat,
         {needle, ball}, 1e-9);
  StoneSettings rough_needle = needle, rough_ball = ball;
  rough_needle.talus_angle = rough_ball.talus_angle = 89.9;
  stones("rough stones under next to nothing", "the same, on which sand rests up to 89.9 degrees", flat,
         {rough_needle, rough_ball}, 1e-9);
  stones("slippery stones under a little", "0.001 degrees, under 1 mm of sand", flat,
         {stone_of(ellipsoid, V(0.0, 0.0, -0.01), V(0.1, 0.08, 0.05), 0.001)}, 1e-3);
  stones("a wall from edge to edge", "one ground_cell thick, up to 1 m", heap,
         {stone_of(box, V(0.5 * ground_cell, 0.0, 0.0), V(ground_cell, 1.0, 2.0))});
  stones("stones over the edge", "in the corners and beyond", heap,
         {stone_of(sphere, V(0.07, 0.04, 0.0), V::Constant(0.05)),
          stone_of(box, V(-0.1, 0.0, 0.0), V(0.08, 0.5, 0.1), 45.0, 10.0)});
  stones("towers of sand on a stone", "1 m on a plate of 20 mm", heap_of(1.0),
         {stone_of(box, V(0.0, 0.0, 0.0), V(0.02, 0.02, 0.02))});
  floor("a floor above the sand", "50 mm above, all bare", flat, 0.05);
  floor("a floor at the sand's height", "all bare", flat, 0.0);
  floor("a floor in a heap", "10 mm above the level", heap, 0.01);
  floor("a floor in noise", "every other ground_cell bare", noise_of(0.02), 0.0);
  floor("a film on a floor", "5e-324 m of sand", flat, 0.0, 5e-324);
  floor("a floor far down", "1 km", noise_of(0.02), -1000.0);

  regions("stripes of a cell", "1 and 89 degrees in turn", stripes(1));
  regions("stripes of a ground_cell on a floor", "1 and 89 degrees in turn, every other ground_cell bare",
          stripes(1));
  all.back().ground.floor = 0.0;
  GroundSettings soft;
  soft.regions = {rectangle_of({0.0, 0.0}, {0.04, 0.04}, 89.0, 1.0),
                  rectangle_of({0.01, 0.01}, {1e-9, 1e-9}, 1.0, 1e-12),
                  rectangle_of({0.0, 0.0}, {1e6, 1e6}, 0.5, 1e6)};
  regions("soft regions wider than the bed", "1 m and 1000 km, and 1 pm around 1 nm", soft);
  GroundSettings none;
  none.regions = {rectangle_of({0.5 * ground_cols * ground_cell + 0.05, 0.0}, {0.1, 0.1}, 89.0)};
  SandRegion line;
  line.shape = RegionShape::polygon;
  line.points = {{0.0, 0.0}, {0.02, 0.0}, {0.04, 0.0}};
  line.talus_angle = 1.0;
  none.regions.push_back(line);
  regions("regions of no area", "one touches the bed's edge, one has its corners in a line", none);
  HostileGround round = all[0];
  round.name = "stones in one another, in a round bed";
  round.shape = BedShape::round;
  all.push_back(round);
  return all;
}

}  // namespace sandstroke
