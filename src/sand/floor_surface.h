#pragma once

#include <Eigen/Core>
#include <limits>
#include <vector>

#include "sand/height_field.h"

namespace sandstroke {

/// The part of a floor around a tool as a closed surface, so that the distance from it changes continuously
/// with a point. Between the centres of four cells it has four triangles around their mean: a plane is exact,
/// and so is its tilt. Where such cells differ by more than `step` cell sizes, there is a step instead: each
/// of them is level, with upright sides half way between. Cells without floor have sides without end. Beyond
/// the bed the floor of its last cells goes on.
class FloorSurface {
 public:
  static constexpr double step = 3.0;  ///< cell sizes

  /// Looks at the floor within `reach` [m] of (x, y) [m]. False: no part of it is above `height` [m]. Costs
  /// hardly more than that where the floor has no tile.
  bool open(const HeightField& floor, double x, double y, double reach, double height);

  /// Height [m] of the surface at (x, y) [m], within the reach.
  double height(double x, double y) const;
  /// How far a point is from the surface [m], and the way there is more room: a unit vector. In the floor the
  /// distance is negative.
  struct Side {
    double distance;
    Eigen::Vector3d outward;
  };
  /// Sides farther than `most` [m] are not looked for: then the distance is `most`. Of a point in the floor
  /// none is farther than the surface above it.
  Side nearest(const Eigen::Vector3d& point, double most) const;

 private:
  struct Search;
  double at(int row, int col) const { return heights_[static_cast<std::size_t>(row) * cols_ + col]; }
  bool has_step(int row, int col) const;
  Eigen::Vector3d local(const Eigen::Vector3d& point) const {
    return {point.x() - first_x_, point.y() - first_y_, point.z()};
  }
  double height_at(double x, double y) const;
  void look_at_triangles(int row, int col, Search& search) const;
  void look_at_steps(int row, int col, Search& search) const;

  double cell_ = 1.0, first_x_ = 0.0, first_y_ = 0.0;        // m, of the window's first cell
  double level_ = -std::numeric_limits<double>::infinity();  // m, where rows_ is 0
  int rows_ = 0, cols_ = 0;                                  // of the window; 0: it is level
  std::vector<double> heights_;                              // m
};

}  // namespace sandstroke
