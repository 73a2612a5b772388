// A tool that sand does not flow into: the cells under it are walls for every relaxer.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "sand/active_sand.h"
#include "sand/sphere_tool.h"
#include "sand/symmetry.h"
#include "sanitized.h"

namespace sandstroke {
namespace {

constexpr double tool_radius = 0.01, cell = 0.002;
const Eigen::Vector3d plunge(0.0, 0.0, -1e-4);

using Relaxers = std::vector<std::unique_ptr<Relaxer>>;
Relaxers engine() {
  RelaxationSettings paper, isotropic, rkl;
  isotropic.law = rkl.law = RelaxationLaw::isotropic;
  rkl.method = RelaxationMethod::rkl;
  Relaxers relaxers;
  for (const RelaxationSettings& settings : {paper, isotropic, rkl})
    relaxers.push_back(make_relaxer(settings, cell));
  return relaxers;
}
Relaxers engine_and_reference() {
  Relaxers relaxers = engine();
  relaxers.push_back(make_plain_relaxer({}, cell));
  return relaxers;
}

/// A tool that has displaced a pit, and stands in it.
struct Standing {
  HeightField bed{129, 129, cell};
  SphereTool tool{{.radius = tool_radius, .profile = ToolProfile::sphere, .solid = true}};
  Standing() {
    tool.place(bed, 0.0, 0.0);
    tool.displace(bed, -0.007, plunge, {Deposit::outward});
    tool.make_walls(bed);
  }
};

TEST(SolidTool, MakesWallsOfTheCellsOfItsBowlAndOfNoOthers) {
  const Standing standing;
  for (int row = 0; row < 129; ++row)
    for (int col = 0; col < 129; ++col) {
      const double from_axis = std::hypot(standing.bed.x_of(col), standing.bed.y_of(row));
      if (std::abs(from_axis - tool_radius) < 1e-9) continue;  // on the rim: as rounding has it
      EXPECT_EQ(standing.bed.is_wall(row, col), from_axis < tool_radius) << row << ", " << col;
    }
}

TEST(SolidTool, NoSandRelaxesUnderItAndWhereItWasItDoes) {
  for (const auto& relaxer : engine_and_reference()) {
    Standing standing;
    HeightField& bed = standing.bed;
    const HeightGrid before = bed.grid();
    const RelaxationOutcome around = relaxer->relax(bed);
    EXPECT_TRUE(around.converged);
    EXPECT_GT(around.passes, 0);
    double heap = 0.0;
    for (int row = 0; row < 129; ++row)
      for (int col = 0; col < 129; ++col) {
        if (bed.is_wall(row, col)) {
          EXPECT_EQ(bed(row, col), before(row, col));
        }
        heap = std::max(heap, bed(row, col));
      }
    EXPECT_EQ(bed(64, 64), -0.007);
    EXPECT_NEAR(bed.volume(), 0.0, 1e-18);

    // Nothing else has changed: the cells that are free again are looked at, and the pit falls in.
    bed.set_tool_walls({});
    const RelaxationOutcome after = relaxer->relax(bed);
    EXPECT_TRUE(after.converged);
    EXPECT_GT(after.passes, 0);
    EXPECT_GT(bed(64, 64), -0.0069);
    EXPECT_LE(after.residual, RelaxationSettings{}.tolerance);
    EXPECT_LE(bed.grid().maxCoeff(), heap);  // no spike
    EXPECT_NEAR(bed.volume(), 0.0, 1e-18);
  }
}

TEST(SolidTool, ChangesNothingEverAtRest) {
  for (const auto& relaxer : engine_and_reference()) {
    Standing standing;
    relaxer->relax(standing.bed);
    // The rim's own cells are the bowl's: what stands there is taken out once.
    standing.tool.place(standing.bed, 0.0, 0.0);
    standing.tool.displace(standing.bed, -0.007, plunge, {Deposit::outward});
    standing.tool.make_walls(standing.bed);
    relaxer->relax(standing.bed);
    const HeightGrid rest = standing.bed.grid();
    for (int i = 0; i < (sanitized ? 20 : 1000); ++i) {
      standing.tool.place(standing.bed, 0.0, 0.0);
      EXPECT_EQ(standing.tool.displace(standing.bed, -0.007, plunge, {Deposit::outward}), 0.0);
      standing.tool.make_walls(standing.bed);
      EXPECT_EQ(relaxer->relax(standing.bed).passes, 0);
    }
    EXPECT_TRUE((standing.bed.grid() == rest).all());
  }
}

TEST(SolidTool, APlungeAtACellCentreIsSymmetricToTheBit) {
  for (const auto& relaxer : engine()) {
    HeightField bed(129, 129, cell);
    SphereTool tool({.radius = tool_radius, .profile = ToolProfile::sphere, .solid = true});
    for (int i = 1; i <= 30; ++i) {
      tool.place(bed, 0.0, 0.0);
      tool.displace(bed, -3e-4 * i, plunge, {Deposit::outward});
      tool.make_walls(bed);
      relaxer->relax(bed);
    }
    EXPECT_TRUE(has_square_symmetry(bed.grid()));
    EXPECT_EQ(bed(64, 64), -3e-4 * 30);
  }
}

TEST(SolidTool, MakesWallsOnlyWhereItIsNow) {
  HeightField bed(129, 129, cell);
  SphereTool tool({.radius = tool_radius, .profile = ToolProfile::sphere, .solid = true});
  for (const double x : {0.03, 0.0, -0.05}) {
    tool.place(bed, x, 0.01);
    tool.make_walls(bed);
    for (int row = 0; row < 129; ++row)
      for (int col = 0; col < 129; ++col)
        ASSERT_EQ(bed.is_wall(row, col),
                  std::hypot(bed.x_of(col) - x, bed.y_of(row) - 0.01) <= tool_radius * (1.0 + 1e-12))
            << row << ", " << col;
  }
}

TEST(SolidTool, TheResidualLeavesOutWhatItStandsOn) {
  for (const RelaxationMethod method : {RelaxationMethod::passes, RelaxationMethod::rkl}) {
    RelaxationSettings settings;
    settings.method = method;
    settings.tolerance = 0.05;
    const auto relaxer = make_relaxer(settings, cell);
    HeightField bed(30, 30, cell);
    bed.set(15, 15, 1.03 * talus_slope(30.0) * cell);  // at rest
    EXPECT_NEAR(relaxer->relax(bed).residual, 0.03, 1e-12);
    bed.set_tool_walls({{0, 15, std::uint64_t{1} << 15}});
    EXPECT_EQ(relaxer->relax(bed).residual, 0.0);
    bed.set_tool_walls({});
    EXPECT_NEAR(relaxer->relax(bed).residual, 0.03, 1e-12);
  }
}

TEST(SolidTool, ACopyOfABedHasItsWalls) {
  Standing standing;
  HeightField copy = standing.bed;
  EXPECT_TRUE(copy.is_wall(64, 64));
  copy.set_tool_walls({});
  EXPECT_FALSE(copy.is_wall(64, 64));
  EXPECT_TRUE(standing.bed.is_wall(64, 64));
}

}  // namespace
}  // namespace sandstroke
