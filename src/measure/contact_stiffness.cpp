#include "measure/contact_stiffness.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/bisection.h"
#include "core/elementary.h"
#include "sim/contact_force.h"
#include "tool/tool_surface.h"

namespace sandstroke {
namespace {

using Eigen::Vector3d;

/// Directions spread evenly over a sphere (by the golden angle), and up, down and along the axes.
std::vector<Vector3d> directions(int count) {
  std::vector<Vector3d> all;
  for (int axis = 0; axis < 3; ++axis)
    for (const double sign : {-1.0, 1.0}) all.push_back(sign * Vector3d::Unit(axis));
  for (int i = 0; i < count; ++i) {
    const double z = 1.0 - (2.0 * i + 1.0) / count, angle = 2.399963229728653 * i,
                 across = std::sqrt(1.0 - z * z);
    all.emplace_back(across * elementary::cos(angle), across * elementary::sin(angle), z);
  }
  return all;
}

/// A tool on level sand. It displaces none, so that only the law is at work.
class LevelSand {
 public:
  explicit LevelSand(const Scene& scene)
      : cell_(scene.bed.cell_size()),
        yield_(scene.strength.yield_way),
        law_(make_contact_force(scene, cell_)),
        sand_(scene.tool, scene.displacement),
        bed_(cells(scene), cells(scene), cell_) {
    sand_.look(bed_, Vector3d::Zero());
  }

  /// The wrench at a depth [m], after the tool has yielded in a direction.
  Wrench at(double depth, const Vector3d& yielded) {
    const Vector3d tip(0.0, 0.0, -depth - sand_.tool().lowest());
    law_->lift();
    return law_->in_tick(sand_, bed_, tip, yield_ * yielded, true);
  }

 private:
  /// Enough cells for the circles on which a law looks for level sand, and for the tool's window. Which of
  /// them it covers does not matter here.
  int cells(const Scene& scene) const {
    return 2 * static_cast<int>(std::ceil(3.0 * tool_reach(scene.tool) / cell_)) + 9;
  }

  double cell_, yield_;
  std::unique_ptr<ToolForce> law_;
  SandSide sand_;
  HeightField bed_;
};

}  // namespace

double contact_stiffness(const Scene& scene, double max_force, bool turns) {
  constexpr double deepest = 1.0;  // m; here a strength that never reaches max_force has stopped growing
  constexpr int all_around = 400, each_when_turned = 100;
  // deg, like tool.orientation: upright and leaning tools, turned in several directions.
  const std::array<Vector3d, 6> leans = {Vector3d(10.0, 20.0, 30.0), {-35.0, 5.0, 60.0}, {0.0, 45.0, 0.0},
                                         {60.0, -10.0, 20.0},        {90.0, 0.0, 45.0},  {5.0, 80.0, -15.0}};
  const auto stiffest = [&](const Scene& posed, int count) {
    LevelSand sand(posed);
    double most = 0.0;
    for (const Vector3d& yielded : directions(count)) {
      const double depth = std::min(deepest, boundary_of_positive([&](double deep) {
                                      return sand.at(deep, yielded).strength < max_force;
                                    }));
      most = std::max(most, sand.at(depth, yielded).limited(max_force).stiffness);
    }
    return most;
  };
  double most = stiffest(scene, all_around);
  if (!turns || scene.tool.shape == ToolShape::sphere) return most;
  for (const Vector3d& lean : leans) {
    Scene leaning = scene;
    leaning.tool.orientation += lean;
    most = std::max(most, stiffest(leaning, each_when_turned));
  }
  return most;
}

}  // namespace sandstroke
