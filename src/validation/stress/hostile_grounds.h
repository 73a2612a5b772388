#pragma once

#include <vector>

#include "sim/scene.h"

namespace sandstroke {

/// The beds of hostile grounds: a bed of two tiles.
inline constexpr double ground_cell = 0.002;  // m
inline constexpr int ground_cols = 70, ground_rows = 40;

/// A bed of sand, and what lies under and in it.
struct HostileGround {
  const char *name, *settings;
  SurfaceSettings surface;
  GroundSettings ground;
  double spread = 0.0;  // m, laid over all of it, stones included
  BedShape shape = BedShape::rectangle;
};

/// Floors, stones and regions that no user would lay.
std::vector<HostileGround> hostile_grounds();

/// size [m]: its diameter for a sphere. talus_angle, turn in deg.
StoneSettings stone_of(StoneShape shape, const Eigen::Vector3d& centre, const Eigen::Vector3d& size,
                       double talus_angle = 0.0, double turn = 0.0);
/// Lengths in m, talus_angle in deg.
SandRegion rectangle_of(const Eigen::Vector2d& centre, const Eigen::Vector2d& size, double talus_angle,
                        double soft = 0.0);
/// A cylinder of 60 mm on the level.
SurfaceSettings heap_of(double height);

}  // namespace sandstroke
