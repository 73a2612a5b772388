// The depth that resistive force theory takes: from the sand before each side of a tool.
#include "sand/sand_before.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "core/angle.h"
#include "sand/resistive_force.h"
#include "sand/tool.h"
#include "tool/tool_surface.h"

namespace sandstroke {
namespace {

using Eigen::Vector3d;
const SandStrength yielding_at_once{30.0, 1560.0, 0.4, 1e-6};

ToolSettings blade(double lean) {
  ToolSettings settings{.radius = 0.01, .profile = ToolProfile::sphere, .solid = true};
  settings.shape = ToolShape::plate;
  settings.width = 0.04;
  settings.height = 0.04;
  settings.thickness = 0.004;
  settings.orientation = {0.0, lean, 0.0};
  return settings;
}

/// The force on a tool that stands in sand of these heights [m], and has yielded in a direction.
Vector3d felt(const ToolSettings& settings, double depth, double cell, const Vector3d& direction,
              const std::function<double(double, double)>& surface = {}) {
  const int side = 2 * static_cast<int>(0.06 / cell) + 1;
  HeightField bed(side, side, cell);
  if (surface)
    for (int row = 0; row < side; ++row)
      for (int col = 0; col < side; ++col) bed.set(row, col, surface(bed.x_of(col), bed.y_of(row)));
  const auto tool = make_tool(settings);
  tool->place(bed, 0.0, 0.0);
  const Vector3d tip(0.0, 0.0, -depth - tool->lowest());
  tool->meet(bed, tip.z());
  tool->read_heights(bed);
  ResistiveForce force(tool_surface(settings), cell);
  force.turn(own_rotation(settings));
  return force.feel(bed, tool->footprint(), tip, 1e-3 * direction, yielding_at_once).force;
}

/// The theory, summed over all of the surface that leads below z = 0, in parts of 1/4 mm.
Vector3d theory(const ToolSettings& settings, double depth, const Vector3d& direction) {
  const auto lowest = [&] {
    const TriangleMesh surface = turned(tool_surface(settings), own_rotation(settings));
    double low = 0.0;
    for (const Vector3d& vertex : surface.vertices) low = std::min(low, vertex.z());
    return low;
  }();
  ToolElements e(tool_surface(settings), 0.00025);
  e.turn(own_rotation(settings));
  Vector3d force = Vector3d::Zero();
  for (int i = 0; i < e.count(); ++i) {
    const Vector3d normal(e.normal_x()[i], e.normal_y()[i], e.normal_z()[i]);
    const double below = depth + lowest - e.z()[i];
    if (below > 0.0 && normal.dot(direction) >= -1e-9)
      force += resistance(yielding_at_once) * below * e.area()[i] *
               resistive_stress(normal, direction, yielding_at_once.tool_friction);
  }
  return force;
}

TEST(SandBefore, LetsABladeFeelTheTheoryHoweverItLeans) {
  for (const double lean : {-45.0, -30.0, -20.0, -10.0, 0.0, 10.0, 20.0, 30.0, 45.0}) {
    const Vector3d exact = theory(blade(lean), 0.012, Vector3d::UnitX());
    for (const double cell : {0.001, 0.0005}) {
      const double error = (felt(blade(lean), 0.012, cell, Vector3d::UnitX()) - exact).norm() / exact.norm();
      EXPECT_LT(error, 20.0 * cell) << lean << " deg, cells of " << cell << " m";
    }
  }
}

TEST(SandBefore, CoversAPlateThatIsPulledUp) {
  ToolSettings plate{.radius = 0.02, .profile = ToolProfile::sphere, .solid = true};
  plate.shape = ToolShape::cylinder;
  plate.height = 0.004;
  const Vector3d exact = theory(plate, 0.024, Vector3d::UnitZ());
  EXPECT_LT(exact.z(), -1.0);
  for (const double cell : {0.002, 0.001, 0.0005})
    EXPECT_LT((felt(plate, 0.024, cell, Vector3d::UnitZ()) - exact).norm(), 0.02 * exact.norm()) << cell;
}

TEST(SandBefore, GivesAHeapTheForceOfCoulombsWedge) {
  // A heap at the angle of friction against the face: its passive force is (1 - sin phi)^2 of level sand's.
  const double depth = 0.006, heap = 0.012, slope = std::tan(to_radians(30.0));
  const double level = felt(blade(0.0), depth + heap, 0.0005, Vector3d::UnitX()).x(),
               heaped = felt(blade(0.0), depth, 0.0005, Vector3d::UnitX(), [&](double x, double) {
                          return x < 0.0 ? 0.0 : heap - slope * (x - 0.002);
                        }).x();
  // The blade's bottom and its narrow sides look at other sand.
  EXPECT_NEAR(heaped / level, 0.25, 0.02);
}

TEST(SandBefore, LeavesLittleToFeelInACleanFurrow) {
  const ToolSettings sphere{.radius = 0.01, .profile = ToolProfile::sphere, .solid = true};
  const double depth = 0.006, first = felt(sphere, depth, 0.001, Vector3d::UnitX()).x(),
               second = felt(sphere, depth, 0.001, Vector3d::UnitX(), [&](double, double y) {
                          const double R = sphere.radius;
                          return std::abs(y) < R ? std::min(0.0, R - depth - std::sqrt(R * R - y * y)) : 0.0;
                        }).x();
  EXPECT_LT(second / first, 0.4);
  EXPECT_GE(second / first, 0.0);
}

}  // namespace
}  // namespace sandstroke
