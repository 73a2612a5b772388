#include "sim/contact_stiffness.h"

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <vector>

#include "core/bisection.h"
#include "sim/contact_force.h"
#include "tool/tool_surface.h"

namespace sandstroke {
namespace {

using Eigen::Vector3d;

/// Towards the faces, edges and corners of a cube.
std::vector<Vector3d> directions() {
  std::vector<Vector3d> all;
  for (int i = 0; i < 27; ++i) {
    const Vector3d towards(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
    if (!towards.isZero(0.0)) all.push_back(towards.normalized());
  }
  return all;
}

/// A tool on level sand that gets out of its way, so that only the law is at work.
class LevelSand {
 public:
  explicit LevelSand(const Scene& scene)
      : cell_(scene.bed.cell_size()),
        yield_(scene.strength.yield_way),
        law_(scene, cell_),
        sand_(scene.tool, scene.displacement, 0.0),
        bed_(cells(scene), cells(scene), cell_) {
    sand_.look(bed_, Vector3d::Zero());
  }

  /// At a depth [m], after the tool has yielded in a direction, and went by `then` [m].
  Wrench at(double depth, const Vector3d& yielded, const Vector3d& then) {
    const Vector3d tip(0.0, 0.0, -depth - sand_.footprint().lowest());
    law_.lift();
    const Wrench full = law_.in_tick(sand_, bed_, tip, yield_ * yielded, true);
    return then.isZero(0.0) ? full : law_.in_tick(sand_, bed_, tip + then, then, true);
  }

 private:
  /// The circles on which the law looks for level sand are inside.
  int cells(const Scene& scene) const {
    return 2 * static_cast<int>(std::ceil(3.0 * tool_reach(scene.tool) / cell_)) + 9;
  }

  double cell_, yield_;
  ContactForce law_;
  SandSide sand_;
  HeightField bed_;
};

}  // namespace

double contact_stiffness(const Scene& scene, double max_force) {
  LevelSand sand(scene);
  constexpr double seen = 2e-5;  // m: about what devices measure
  const double step = std::min(0.05 * scene.strength.yield_way, seen);
  constexpr double deepest = 1.0;  // m, where lift that never reaches max_force does not grow any more
  double stiffest = 0.0;
  for (const Vector3d& yielded : directions()) {
    const double depth = std::min(deepest, boundary_of_positive([&](double deep) {
                                    return sand.at(deep, yielded, Vector3d::Zero()).strength < max_force;
                                  }));
    const Vector3d before = sand.at(depth, yielded, Vector3d::Zero()).limited(max_force).force;
    for (const double sign : {-1.0, 1.0}) {
      Eigen::Matrix3d change;
      for (int axis = 0; axis < 3; ++axis)
        change.col(axis) =
            (sand.at(depth, yielded, sign * step * Vector3d::Unit(axis)).limited(max_force).force - before) /
            step;
      stiffest = std::max(stiffest, change.jacobiSvd().singularValues()[0]);
    }
  }
  return stiffest;
}

}  // namespace sandstroke
