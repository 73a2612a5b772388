// Beds in a round wall, as sand tables are.
#include <gtest/gtest.h>

#include <cmath>

#include "sand/all_laws.h"
#include "sand/initial_surface.h"
#include "sand/relaxation.h"
#include "sand/sphere_tool.h"

namespace sandstroke {
namespace {

constexpr double width = 0.002;  // m, of a cell

TEST(RoundBed, HasTheCellsWhoseCentresLieInItsLargestCircle) {
  for (const auto& [rows, cols] : {std::pair(130, 130), {129, 129}, {70, 131}, {131, 70}, {1, 1}}) {
    HeightField bed(rows, cols, width, BedShape::round);
    const double radius = 0.5 * width * std::min(rows, cols);
    EXPECT_DOUBLE_EQ(bed.wall_radius(), radius);
    for (int row = 0; row < rows; ++row)
      for (int col = 0; col < cols; ++col) {
        const double from_centre = std::hypot(bed.x_of(col), bed.y_of(row));
        if (std::abs(from_centre - radius) < 1e-12) continue;  // on the wall: as rounding has it
        EXPECT_DOUBLE_EQ(bed.beyond_edge(bed.x_of(col), bed.y_of(row)), from_centre - radius);
        ASSERT_EQ(bed.has_sand(row, col), from_centre < radius) << row << ", " << col;
        ASSERT_EQ(bed.is_wall(row, col), !bed.has_sand(row, col)) << "before its tile is there";
        ASSERT_EQ(bed.has_sand(row, col), bed.has_sand(rows - 1 - row, cols - 1 - col)) << "symmetric";
      }
  }
}

TEST(RoundBed, ItsWallStaysWhereAToolStood) {
  HeightField bed(130, 130, width, BedShape::round);
  SphereTool tool({.radius = 0.01, .profile = ToolProfile::sphere, .solid = true});
  tool.place(bed, bed.wall_radius() - 0.005, 0.0);
  tool.make_walls(bed);
  bed.set_tool_walls({});
  for (int row = 0; row < 130; ++row)
    for (int col = 0; col < 130; ++col) ASSERT_EQ(bed.is_wall(row, col), !bed.has_sand(row, col));
}

/// Sand moves, none beyond the wall, and none is lost.
void expect_kept_inside(const HeightField& before, const HeightField& after) {
  double moved = 0.0;
  for (int row = 0; row < before.rows(); ++row)
    for (int col = 0; col < before.cols(); ++col) {
      if (!before.has_sand(row, col)) {
        ASSERT_EQ(after(row, col), before(row, col)) << row << ", " << col;
      }
      moved += std::abs(after(row, col) - before(row, col));
    }
  EXPECT_GT(moved, 0.0);
  EXPECT_NEAR(after.volume(), before.volume(), 1e-15);
}

TEST(RoundBed, SandThatRelaxesStaysInside) {
  SurfaceSettings cliff;
  cliff.kind = SurfaceKind::cliff;
  cliff.height = 0.02;
  for (const RelaxationLaw law : all_laws) {
    HeightField bed = make_surface(cliff, 130, 130, width, BedShape::round);
    const HeightField before = bed;
    RelaxationSettings settings;
    settings.law = law;
    EXPECT_TRUE(make_relaxer(settings, width)->relax(bed).converged);
    expect_kept_inside(before, bed);
  }
}

TEST(RoundBed, AToolAtTheWallPushesSandInside) {
  for (const Deposit deposit : {Deposit::ring, Deposit::ahead, Deposit::outward}) {
    HeightField bed(130, 130, width, BedShape::round);
    const HeightField before = bed;
    SphereTool tool({.radius = 0.01, .profile = ToolProfile::sphere, .solid = true});
    const double along = (bed.wall_radius() - 0.005) * std::sqrt(0.5);
    tool.place(bed, along, along);
    EXPECT_EQ(tool.sand_level(), 0.0);
    EXPECT_GT(tool.displace(bed, -0.004, {1e-3, 1e-3, 0.0}, {deposit}), 0.0);
    expect_kept_inside(before, bed);
  }
}

TEST(RoundBed, TheLevelUnderAToolIsThatOfTheSandAlone) {
  HeightField bed(130, 130, width, BedShape::round);
  for (int row = 0; row < 130; ++row)
    for (int col = 0; col < 130; ++col)
      if (!bed.has_sand(row, col)) bed.set(row, col, 1.0);
  SphereTool tool({.radius = 0.01, .profile = ToolProfile::sphere, .solid = true});
  tool.place(bed, 0.0, bed.wall_radius() - 0.003);
  EXPECT_EQ(tool.sand_level(), 0.0);
}

TEST(RoundBed, AToolBeyondTheWallFindsNoLevel) {
  HeightField bed(130, 130, width, BedShape::round);
  SphereTool tool({.radius = 0.01, .profile = ToolProfile::sphere, .solid = true});
  tool.place(bed, bed.wall_radius(), bed.wall_radius());  // a corner of the rectangle
  EXPECT_TRUE(std::isnan(tool.sand_level()));
  EXPECT_EQ(tool.displace(bed, -0.004, Eigen::Vector3d::Zero(), {}), 0.0);
}

}  // namespace
}  // namespace sandstroke
