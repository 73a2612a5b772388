// Computes single ticks of resistive force theory (force.law = "rft") in flat sand that nothing has touched:
// for each line of the input `shape depth cell qx qy qz qw ux uy uz` [m; the tool's turn; its direction] the
// force [N] and the torque about the tip [N m].
#include <iostream>
#include <map>
#include <string>

#include "sand/resistive_force.h"
#include "sand/tool.h"
#include "tool/tool_surface.h"

namespace {

using namespace sandstroke;

const std::map<std::string, ToolShape> shapes = {{"sphere", ToolShape::sphere},
                                                 {"cylinder", ToolShape::cylinder},
                                                 {"cone", ToolShape::cone},
                                                 {"box", ToolShape::box},
                                                 {"plate", ToolShape::plate}};

Wrench felt(ToolShape shape, double depth, double cell, const Eigen::Matrix3d& rotation,
            const Eigen::Vector3d& direction) {
  constexpr double half_bed = 0.1;  // m
  const SandStrength yielding_at_once{30.0, 1560.0, 0.4, 1e-6};
  ToolSettings settings{.radius = 0.01, .profile = ToolProfile::sphere, .solid = true};
  settings.shape = shape;
  settings.width = 0.04;
  const int side = 2 * static_cast<int>(half_bed / cell) + 1;
  HeightField bed(side, side, cell);
  const auto tool = make_tool(settings);
  tool->turn(rotation);
  tool->place(bed, 0.0, 0.0);
  const Eigen::Vector3d tip(0.0, 0.0, -depth - tool->lowest());
  tool->meet(bed, tip.z());
  tool->read_heights(bed);
  static std::map<std::pair<ToolShape, double>, ResistiveForce> forces;
  ResistiveForce& force = forces.try_emplace({shape, cell}, tool_surface(settings), cell).first->second;
  force.lift();
  force.turn(rotation);
  return force.feel(bed, tool->footprint(), tip, 1e-3 * direction, yielding_at_once);
}

}  // namespace

int main() {
  std::string shape;
  double depth, cell;
  Eigen::Quaterniond turn;
  Eigen::Vector3d direction;
  std::cout.precision(12);
  while (std::cin >> shape >> depth >> cell >> turn.x() >> turn.y() >> turn.z() >> turn.w() >>
         direction.x() >> direction.y() >> direction.z()) {
    const Wrench wrench = felt(shapes.at(shape), depth, cell, rotation_of(turn), direction);
    std::cout << wrench.force.transpose() << ' ' << wrench.torque.transpose() << '\n';
  }
}
