// What tools leave on a bed with a floor: the floor itself, and all sand.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "sand/ground.h"
#include "sand/shaped_tool.h"
#include "sand/sphere_tool.h"
#include "tool/tool_surface.h"

namespace sandstroke {
namespace {

constexpr double floor_cell = 0.001;
const Eigen::Vector3d pressed_by(0.0, 0.0, -0.001);

std::vector<ToolSettings> every_tool() {
  std::vector<ToolSettings> tools;
  for (const ToolShape shape : {ToolShape::sphere, ToolShape::cylinder, ToolShape::cone, ToolShape::box,
                                ToolShape::plate, ToolShape::rake, ToolShape::mesh}) {
    ToolSettings tool{.radius = 0.008, .profile = ToolProfile::sphere, .solid = true};
    tool.shape = shape;
    tool.height = tool.width = 0.03;
    tool.size = {0.02, 0.014, 0.03};
    tool.spacing = 0.02;
    if (shape == ToolShape::mesh) tool.mesh = std::make_shared<TriangleMesh>(tool_surface({.radius = 0.008}));
    tools.push_back(tool);
  }
  return tools;
}

/// A bed of rough sand over `ground`.
HeightField rough_sand(std::shared_ptr<const Ground> ground, double least, double most, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> height(least, most);
  HeightField bed(91, 97, floor_cell);
  for (int row = 0; row < bed.rows(); ++row)
    for (int col = 0; col < bed.cols(); ++col) bed.set(row, col, height(random));
  bed.lie_on(std::move(ground));
  return bed;
}

std::shared_ptr<Ground> level_ground(double height) {
  return std::make_shared<Ground>(HeightField(91, 97, floor_cell), height, 0.6);
}

TEST(DisplacementOverAFloor, LeavesABareFootprintWhereTheToolGoesThrough) {
  // No round number: differences of such heights are rounded.
  const double floor = -0.0037123456789;
  for (const ToolSettings& settings : every_tool()) {
    HeightField bed = rough_sand(level_ground(floor), -0.002, 0.003, 7);
    const double before = bed.volume();
    const std::unique_ptr<Tool> tool = make_tool(settings);
    tool->place(bed, 0.00031, -0.00023);
    const double tip = floor - 0.002;
    const double moved = tool->displace(bed, tip, pressed_by, {Deposit::outward});
    EXPECT_GT(moved, 0.0);
    EXPECT_NEAR(bed.volume(), before, 1e-14 * moved + 1e-15 * std::abs(before));
    const ToolFootprint& f = tool->footprint();
    int bare = 0;
    for (int row = 0; row < f.cells().rows(); ++row)
      for (int col = 0; col < f.cells().cols(); ++col) {
        const double left = bed(f.cells().row_begin + row, f.cells().col_begin + col);
        ASSERT_GE(left, floor);
        if (tip + f.underside(row)[col] > floor) continue;
        ASSERT_EQ(left, floor);
        ++bare;
      }
    EXPECT_GT(bare, 0);
    EXPECT_EQ(tool->displace(bed, tip, pressed_by, {Deposit::outward}), 0.0) << "a second time";
  }
}

TEST(DisplacementOverAFloor, NeverGoesBelowIt) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> real(-1.0, 1.0);
  for (const ToolSettings& settings : every_tool()) {
    const auto ground = level_ground(-0.002);
    for (int row = 20; row < 60; ++row)
      for (int col = 15; col < 80; ++col) ground->floor.set(row, col, 0.004 * real(random));
    HeightField bed = rough_sand(ground, -0.002, 0.003, 5);
    const double before = bed.volume();
    double moved = 0.0;
    const std::unique_ptr<Tool> tool = make_tool(settings);
    for (int i = 0; i < 40; ++i) {
      tool->place(bed, 0.04 * real(random), 0.04 * real(random));
      moved += tool->displace(bed, 0.005 * real(random), pressed_by, {Deposit::outward});
    }
    EXPECT_GT(moved, 0.0);
    EXPECT_NEAR(bed.volume(), before, 1e-13 * moved + 1e-15 * std::abs(before));
    for (int row = 0; row < bed.rows(); ++row)
      for (int col = 0; col < bed.cols(); ++col) ASSERT_GE(bed(row, col), ground->floor(row, col));
  }
}

TEST(DisplacementOverAFloor, OfASpherePutsNoSandOnATallStone) {
  const ToolSettings settings = every_tool().front();
  for (const Deposit deposit : {Deposit::ring, Deposit::ahead, Deposit::outward}) {
    const auto ground = std::make_shared<Ground>(HeightField(91, 97, floor_cell), 0.6);
    for (int row = 0; row < 91; ++row)
      for (int col = 0; col < 97; ++col)
        if (ground->floor.x_of(col) > 0.0085) ground->floor.set(row, col, 0.05);
    HeightField bed = rough_sand(ground, -0.001, 0.001, 2);
    const double before = bed.volume();
    const std::unique_ptr<Tool> tool = make_tool(settings);
    tool->place(bed, 0.0, 0.0);
    const double moved = tool->displace(bed, -0.004, {0.001, 0.0, -0.0001}, {deposit});
    EXPECT_GT(moved, 0.0);
    EXPECT_NEAR(bed.volume(), before, 1e-14 * moved + 1e-15 * std::abs(before));
    for (int row = 0; row < 91; ++row)
      for (int col = 0; col < 97; ++col) ASSERT_TRUE(bed.floor(row, col) < 0.0 || bed(row, col) == 0.05);
  }
}

TEST(DisplacementOverAFloor, HasTheBitsOfNoneWhereThatIsDeep) {
  for (const ToolSettings& settings : every_tool())
    for (const double depth : {0.0099, 0.1, 1e6}) {
      HeightField bed = rough_sand(nullptr, -0.002, 0.003, 9), on_floor = bed;
      on_floor.lie_on(level_ground(-depth));
      for (HeightField* one : {&bed, &on_floor}) {
        const std::unique_ptr<Tool> tool = make_tool(settings);
        for (int i = 0; i < 5; ++i) {
          tool->place(*one, 0.0031 * i, -0.0023);
          tool->displace(*one, -0.0095, pressed_by, {Deposit::outward});
        }
      }
      EXPECT_TRUE((bed.grid() == on_floor.grid()).all()) << depth;
    }
}

TEST(DisplacementOverAFloor, CountsTheDepthOfSandOnly) {
  const double floor = -0.003;
  SphereTool tool({.radius = 0.008});
  HeightField sand(91, 97, floor_cell), bare(91, 97, floor_cell);
  sand.lie_on(level_ground(floor));
  bare.lie_on(level_ground(0.0));
  tool.place(sand, 0.0, 0.0);
  EXPECT_EQ(tool.depth(-0.002), 0.002);
  EXPECT_NEAR(tool.depth(-0.004), 0.003, 1e-15) << "the sand's thickness, whatever goes into the floor";
  tool.place(bare, 0.0, 0.0);
  EXPECT_EQ(tool.depth(0.001), -0.001);
  EXPECT_NEAR(tool.depth(-0.004), 0.0, 1e-15);
}

}  // namespace
}  // namespace sandstroke
