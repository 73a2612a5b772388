// The depth that resistive force theory takes: from the sand before each side of a tool.
#include "sand/sand_before.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "core/angle.h"
#include "sand/resistive_force.h"
#include "sand/tool.h"
#include "tool/tool_surface.h"

namespace sandstroke {
namespace {

using Eigen::Vector3d;
using std::numbers::pi;
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

TEST(SandBefore, ClosesTheHollowThatAToolLeaves) {
  // What a tool has cut away stays away in a height field when the tool goes on by a little.
  ToolSettings plate{.radius = 0.02, .profile = ToolProfile::sphere, .solid = true};
  plate.shape = ToolShape::cylinder;
  plate.height = 0.004;
  const auto dragged = [](double lean) { return std::pair(blade(lean), Vector3d(Vector3d::UnitX())); };
  for (const auto& [settings, direction] :
       {std::pair(plate, Vector3d(Vector3d::UnitZ())), dragged(-45.0), dragged(-20.0), dragged(-10.0)})
    for (const double cell : {0.002, 0.001, 0.0005}) {
      constexpr double depth = 0.012, way = 2e-5;
      const int side = 2 * static_cast<int>(0.1 / cell) + 1;
      HeightField bed(side, side, cell);
      const auto tool = make_tool(settings);
      ResistiveForce force(tool_surface(settings), cell);
      force.turn(own_rotation(settings));
      Vector3d felt_last;
      for (int tick = 0; tick <= 10; ++tick) {
        const Vector3d tip = Vector3d(0.0, 0.0, -depth - tool->lowest()) + 0.1 * tick * way * direction;
        tool->place(bed, tip.x(), tip.y());
        tool->displace(bed, tip.z(), direction, {.deposit = Deposit::outward});
        felt_last =
            force
                .feel(bed, tool->footprint(), tip,
                      tick == 0 ? Vector3d::Zero() : Vector3d(0.1 * way * direction), yielding_at_once)
                .force;
      }
      const Vector3d exact = theory(settings, depth, direction);
      EXPECT_LT((felt_last - exact).norm(), std::max(0.02, 20.0 * cell) * exact.norm())
          << settings.orientation.y() << " deg, cells of " << cell << " m";
    }
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

/// A pipe wall, 40 mm high, that looks out or in.
void add_wall(TriangleMesh& mesh, double x, double radius, bool looks_out) {
  constexpr int sides = 64;
  const auto first = static_cast<std::int32_t>(mesh.vertices.size());
  for (int i = 0; i < sides; ++i)
    for (const double z : {0.0, 0.04})
      mesh.vertices.emplace_back(x + radius * std::cos(2.0 * pi * i / sides),
                                 radius * std::sin(2.0 * pi * i / sides), z);
  for (int i = 0; i < sides; ++i) {
    const std::int32_t a = first + 2 * i, b = first + 2 * ((i + 1) % sides);
    if (looks_out) {
      mesh.triangles.push_back({a, b, b + 1});
      mesh.triangles.push_back({a, b + 1, a + 1});
    } else {
      mesh.triangles.push_back({b, a, b + 1});
      mesh.triangles.push_back({b + 1, a, a + 1});
    }
  }
}

/// A disc that looks up, just above the tip.
void add_floor(TriangleMesh& mesh, double radius) {
  constexpr int sides = 64;
  const auto middle = static_cast<std::int32_t>(mesh.vertices.size());
  mesh.vertices.emplace_back(0.0, 0.0, 0.001);
  for (int i = 0; i < sides; ++i)
    mesh.vertices.emplace_back(radius * std::cos(2.0 * pi * i / sides),
                               radius * std::sin(2.0 * pi * i / sides), 0.001);
  for (int i = 0; i < sides; ++i)
    mesh.triangles.push_back({middle, middle + 1 + i, middle + 1 + (i + 1) % sides});
}

/// The force on this surface, as that of a cylinder of R 20 mm that stands 12 mm deep and has yielded.
Vector3d felt_on(const TriangleMesh& surface, const Vector3d& direction) {
  constexpr double cell = 0.001, depth = 0.012;
  HeightField bed(161, 161, cell);
  ToolSettings round{.radius = 0.02, .profile = ToolProfile::sphere, .solid = true};
  round.shape = ToolShape::cylinder;
  const auto tool = make_tool(round);
  tool->place(bed, 0.0, 0.0);
  tool->meet(bed, -depth);
  ResistiveForce force(surface, cell);
  return force.feel(bed, tool->footprint(), {0.0, 0.0, -depth}, 1e-3 * direction, yielding_at_once).force;
}

TEST(SandBefore, HasNoSandInACup) {
  // A height field has none there, whichever way the cup goes. Its outside is a cylinder's.
  for (const Vector3d& direction :
       {Vector3d(1.0, 0.0, 0.0), Vector3d(0.0, 0.0, 1.0), Vector3d(0.6, 0.0, 0.8)}) {
    TriangleMesh cup;
    add_wall(cup, 0.0, 0.02, true);
    const Vector3d outside = felt_on(cup, direction);
    EXPECT_GT(outside.norm(), 0.01);
    add_wall(cup, 0.0, 0.018, false);
    add_floor(cup, 0.018);
    EXPECT_LT((felt_on(cup, direction) - outside).norm(), 0.01 * outside.norm()) << direction;
  }
}

TEST(SandBefore, LetsNoToothShieldAnother) {
  // Two pipes, one before the other, feel what they feel side by side.
  const auto pair_of = [](double apart, const Vector3d& direction) {
    TriangleMesh pipes;
    add_wall(pipes, -0.5 * apart, 0.004, true);
    add_wall(pipes, 0.5 * apart, 0.004, true);
    return felt_on(pipes, direction).norm();
  };
  const double along = pair_of(0.024, Vector3d::UnitX()), across = pair_of(0.024, Vector3d::UnitY());
  EXPECT_NEAR(along, across, 0.03 * across);
}

TEST(SandBefore, FeelsASlopeUnderAFlatTool) {
  // A box is pressed into a slope: 0.87574 xi times the volume of its underside below the sand, and a torque.
  ToolSettings box{.radius = 0.02, .profile = ToolProfile::sphere, .solid = true};
  box.shape = ToolShape::box;
  box.width = box.height = 0.04;
  box.thickness = 0.04;
  constexpr double cell = 0.001, slope = 0.17632698;  // 10 deg
  for (const double middle : {-0.002, 0.0, 0.006}) {  // m, of the sand over the middle of the underside
    HeightField bed(181, 181, cell);
    for (int row = 0; row < bed.rows(); ++row)
      for (int col = 0; col < bed.cols(); ++col) bed.set(row, col, slope * bed.x_of(col));
    const auto tool = make_tool(box);
    tool->place(bed, 0.0, 0.0);
    tool->meet(bed, -middle);
    ResistiveForce force(tool_surface(box), 0.0005);
    const Wrench felt =
        force.feel(bed, tool->footprint(), {0.0, 0.0, -middle}, {0.0, 0.0, -1e-3}, yielding_at_once);
    double volume = 0.0, moment = 0.0;
    const TriangleMesh surface = tool_surface(box);
    double half_x = 0.0, half_y = 0.0;
    for (const Vector3d& vertex : surface.vertices) {
      half_x = std::max(half_x, vertex.x());
      half_y = std::max(half_y, vertex.y());
    }
    constexpr int parts = 1000;
    for (int i = 0; i < parts; ++i) {
      const double x = half_x * (2.0 * (i + 0.5) / parts - 1.0), below = std::max(middle + slope * x, 0.0);
      volume += below * 4.0 * half_x * half_y / parts;
      moment += x * below * 4.0 * half_x * half_y / parts;
    }
    const double per_volume = 0.87574 * resistance(yielding_at_once);
    EXPECT_NEAR(felt.force.z(), per_volume * volume, 0.08 * per_volume * volume) << middle;
    EXPECT_NEAR(felt.torque.y(), -per_volume * moment, 0.08 * per_volume * moment) << middle;
  }
}

TEST(SandBefore, FeelsNoMoreThanTheHighestSandBesideIt) {
  // A furrow behind the blade, level sand before it: its underside feels no more than level sand.
  const double level = felt(blade(0.0), 0.012, 0.001, Vector3d::UnitX()).z(),
               furrow = felt(blade(0.0), 0.012, 0.001, Vector3d::UnitX(), [](double x, double) {
                          return x < 0.0 ? -0.011 : 0.0;
                        }).z();
  EXPECT_LE(furrow, level * (1.0 + 1e-9));
}

TEST(SandBefore, KeepsWhatItFeltAtTheBedsWall) {
  // A blade goes towards the wall, and the cells before it come to an end.
  constexpr double cell = 0.001, depth = 0.006;
  HeightField bed(81, 81, cell);
  const ToolSettings settings = blade(0.0);
  const auto tool = make_tool(settings);
  ResistiveForce force(tool_surface(settings), cell);
  double before = 0.0;
  for (double x = 0.0; x < 0.04; x += 0.0005) {
    tool->place(bed, x, 0.0);
    tool->meet(bed, -depth);
    const double drag =
        force.feel(bed, tool->footprint(), {x, 0.0, -depth}, {5e-4, 0.0, 0.0}, yielding_at_once).force.x();
    ASSERT_LT(drag, -0.05) << x;
    if (before < 0.0) {
      EXPECT_NEAR(drag, before, 0.02 * std::abs(before)) << x;
    }
    before = drag;
  }
}

}  // namespace
}  // namespace sandstroke
