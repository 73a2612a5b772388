// Tools of any shape: what their envelope and the sand beside them must be.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "sand/displacement.h"
#include "sand/distance_transform.h"
#include "sand/relaxation.h"
#include "tool/tool_surface.h"

namespace sandstroke {
namespace {

using std::numbers::pi;
constexpr double cell_side = 0.001;
const DisplacementSettings out{Deposit::outward};

ToolSettings solid_tool(ToolShape shape) {
  ToolSettings tool{0.01, ToolProfile::sphere, true};
  tool.shape = shape;
  tool.height = 0.03;
  tool.width = 0.03;
  tool.spacing = 0.015;
  tool.teeth = 3;
  tool.radius = shape == ToolShape::rake ? 0.004 : 0.01;
  return tool;
}
ToolSettings mesh_sphere(double radius) {
  ToolSettings sphere{radius};
  ToolSettings tool{radius, ToolProfile::sphere, true, ToolShape::mesh};
  tool.mesh = std::make_shared<TriangleMesh>(tool_surface(sphere));
  return tool;
}
const std::vector<ToolShape> any_shape = {ToolShape::cylinder, ToolShape::cone, ToolShape::box,
                                          ToolShape::plate, ToolShape::rake};

TEST(SignedDistance, IsThatToTheNearestOtherSample) {
  constexpr int rows = 13, cols = 17;
  std::vector<unsigned char> covered(rows * cols);
  for (int i = 0; i < rows * cols; ++i) covered[i] = (i * 7919) % 11 < 8 && i / cols > 1;
  const std::vector<double> found = signed_distance(covered, rows, cols),
                            inside = distance_inside(covered, rows, cols);
  for (int i = 0; i < rows * cols; ++i) {
    double nearest = 1e9;
    for (int j = 0; j < rows * cols; ++j)
      if (covered[j] != covered[i])
        nearest = std::min(nearest, std::hypot(i % cols - j % cols, i / cols - j / cols));
    EXPECT_EQ(inside[i], std::max(found[i], 0.0));
    EXPECT_NEAR(found[i], covered[i] ? nearest - 0.5 : 0.5 - nearest, 1e-6);
  }
}

TEST(AnyTool, TakesOutWhatStandsAboveItsUndersideAndKeepsAllSand) {
  for (const ToolShape shape : any_shape) {
    HeightField bed(161, 161, cell_side);
    ToolFootprint footprint(solid_tool(shape));
    footprint.place(bed, 0.00031, -0.00047);
    const double pushed = displace(bed, footprint, -0.004, {0.0, 0.0, -0.004}, out);
    EXPECT_GT(pushed, 0.0);
    EXPECT_NEAR(bed.volume(), 0.0, 1e-12 * pushed);
    const ToolSettings tool = solid_tool(shape);
    const double d = 0.004;
    const double tooth = pi * (0.004 * d * d - d * d * d / 3.0);  // a cap of its sphere
    const double expected = shape == ToolShape::cylinder ? pi * 1e-4 * d
                            : shape == ToolShape::cone   ? pi * std::pow(d / 3.0, 2) * d / 3.0
                            : shape == ToolShape::box    ? tool.size.x() * tool.size.y() * d
                            : shape == ToolShape::plate  ? tool.thickness * tool.width * d
                                                         : 3.0 * tooth;
    EXPECT_NEAR(pushed, expected, 0.12 * expected) << static_cast<int>(shape);
    // A second time there is nothing to take out.
    footprint.place(bed, 0.00031, -0.00047);
    EXPECT_EQ(displace(bed, footprint, -0.004, {0.0, 0.0, 0.0}, out), 0.0);
  }
}

TEST(AnyTool, ASphereAsAMeshLeavesWhatTheSphereLeaves) {
  const double R = 0.01;
  for (const double cell : {0.002, 0.001, 0.0005}) {
    const int side = static_cast<int>(std::lround(0.12 / cell)) + 1;
    const auto relaxed_after = [&](const ToolSettings& tool) {
      RelaxationSettings settings;
      settings.law = RelaxationLaw::isotropic;
      settings.method = RelaxationMethod::rkl;
      const auto relaxer = make_relaxer(settings, cell);
      HeightField bed(side, side, cell);
      ToolFootprint footprint(tool);
      for (int i = 0; i <= 40; ++i) {
        footprint.place(bed, -0.02 + 0.001 * i + 0.0001, 0.0003);
        displace(bed, footprint, -0.006, {0.001, 0.0, 0.0}, out);
        footprint.hold_bowl(bed);
        relaxer->relax(bed);
      }
      bed.hold({});
      relaxer->relax(bed);
      return bed.grid();
    };
    const HeightGrid sphere = relaxed_after({R, ToolProfile::sphere, true}),
                     mesh = relaxed_after(mesh_sphere(R));
    const double misplaced = (sphere - mesh).abs().sum() / sphere.abs().sum();
    RecordProperty("cell_" + std::to_string(side), std::to_string(misplaced));
    EXPECT_LT(misplaced, 30.0 * cell);  // 5.3, 2.8, 0.6 % of the moved sand
  }
}

/// A drag with a plunge, at places that `turn` quarter turns take to others.
HeightGrid dragged(ToolShape shape, int quarters, int side) {
  HeightField bed(side, side, cell_side);
  ToolFootprint footprint(solid_tool(shape));
  const double half = 0.25 * pi * quarters;
  footprint.turn(rotation_of(Eigen::Quaterniond(std::cos(half), 0.0, 0.0, std::sin(half))));
  RelaxationSettings settings;
  settings.law = RelaxationLaw::isotropic;
  const auto relaxer = make_relaxer(settings, cell_side);
  for (int i = 0; i <= 12; ++i) {
    Eigen::Vector2d at(0.0007 * i - 0.004, 0.00033 + 0.0002 * i);
    for (int turn = 0; turn < quarters; ++turn) at = Eigen::Vector2d(-at.y(), at.x());
    footprint.place(bed, at.x(), at.y());
    displace(bed, footprint, -0.0053, {0.0, 0.0, 0.0}, out);
    footprint.hold_bowl(bed);
    relaxer->relax(bed);
  }
  bed.hold({});
  relaxer->relax(bed);
  return bed.grid();
}

TEST(AnyTool, TurnedByAQuarterItLeavesTheSameBits) {
  for (const ToolShape shape : any_shape)
    for (const int side : {128, 129}) {
      const HeightGrid one = dragged(shape, 0, side), turned = dragged(shape, 1, side);
      for (int row = 0; row < side; ++row)
        for (int col = 0; col < side; ++col)
          ASSERT_EQ(one(row, col), turned(col, side - 1 - row))
              << static_cast<int>(shape) << " " << row << " " << col;
    }
}

TEST(AnyTool, APlateCarriesSandAheadOfItAndNoneBehind) {
  HeightField bed(121, 121, cell_side);
  ToolSettings plate = solid_tool(ToolShape::plate);
  ToolFootprint footprint(plate);
  footprint.place(bed, 0.0, 0.0);
  displace(bed, footprint, -0.003, {0.0, 0.0, 0.0}, out);
  const HeightGrid before = bed.grid();
  footprint.place(bed, 0.0015, 0.0);
  ASSERT_GT(displace(bed, footprint, -0.003, {0.0015, 0.0, 0.0}, out), 0.0);
  const HeightGrid change = bed.grid() - before;
  EXPECT_GT(change.rightCols(60).maxCoeff(), 0.0);
  EXPECT_EQ(change.leftCols(60).maxCoeff(), 0.0);
}

}  // namespace
}  // namespace sandstroke
