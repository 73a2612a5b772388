#include "sand/tool_footprint.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "sand/sphere_tool.h"

namespace sandstroke {
namespace {

constexpr double radius = 0.01;
constexpr double high_above = 1.0;  // m, height of a tip that carves nothing

/// Calls body(distance to the tool's axis, underside, ring_weight) for each cell of the footprint, and checks
/// that entries beyond its columns have no weight.
template <class Body>
void for_each_cell(HeightField& bed, SphereTool& tool, const Body& body) {
  tool.displace(bed, high_above, Eigen::Vector3d::Zero(), {Deposit::ring});
  const CellRange& cells = tool.footprint().cells();
  for (int r = 0; r < cells.rows(); ++r)
    for (int c = 0; c < tool.footprint().stride(); ++c) {
      const double x = (tool.footprint().first_x() + c - tool.footprint().axis_x()) * bed.cell_size();
      const double y = (tool.footprint().first_y() + r - tool.footprint().axis_y()) * bed.cell_size();
      if (c < cells.cols()) {
        body(std::sqrt(x * x + y * y), tool.footprint().underside(r)[c], tool.footprint().ring_weight(r)[c]);
      } else {
        EXPECT_TRUE(std::isinf(tool.footprint().underside(r)[c]));
        EXPECT_EQ(tool.footprint().ring_weight(r)[c], 0.0);
      }
    }
}

TEST(Filter, RootsAreWhereThePaperPutsThem) {
  EXPECT_NEAR(std::sin(filter::u0), 0.53, 1e-15);
  EXPECT_NEAR(filter::u0, 0.558601, 1e-6);
  EXPECT_NEAR(1.0 - std::cos(filter::u1), 0.53 * filter::u1, 1e-15);
  EXPECT_NEAR(filter::u1, 1.2, 0.006);  // the paper's printed limit, to its two digits
}

TEST(Filter, ItsPlaneIntegralIsZero) {
  // integral of g over the plane = pi s^2 int_0^u1 (sin u - 0.53) du, by Simpson's rule here
  const int n = 2000;
  double sum = 0.0;
  for (int i = 0; i <= n; ++i) {
    const double u = filter::u1 * i / n;
    sum += (i == 0 || i == n ? 1.0 : i % 2 ? 4.0 : 2.0) * (std::sin(u) - 0.53);
  }
  EXPECT_NEAR(sum * filter::u1 / n / 3.0, 0.0, 1e-14);
}

TEST(ToolFootprint, SampledFilterSumsToZeroAsCellsShrink) {
  for (const int n : {101, 201, 401}) {
    const double dx = 0.04 / n;
    HeightField bed(n, n, dx);
    SphereTool tool({radius, ToolProfile::paper});
    tool.place(bed, 0.0, 0.0);
    const double s2 = radius * radius / filter::u0;
    double sum = 0.0, magnitude = 0.0;
    for_each_cell(bed, tool, [&](double rho, double underside, double ring_weight) {
      if (std::isinf(underside) && ring_weight == 0.0) return;
      const double g = std::sin(rho * rho / s2) - 0.53;
      if (ring_weight > 0.0) {
        EXPECT_NEAR(ring_weight, g, 1e-15);
      }
      sum += g;
      magnitude += std::abs(g);
    });
    EXPECT_LT(std::abs(sum) / magnitude, 0.5 * dx / radius) << n;
  }
}

TEST(ToolFootprint, BothUndersidesHaveTheSpheresCurvatureAndWidth) {
  HeightField bed(401, 401, 1e-4);
  for (const ToolProfile profile : {ToolProfile::paper, ToolProfile::sphere}) {
    SphereTool tool({radius, profile});
    tool.place(bed, 0.0, 0.0);
    for_each_cell(bed, tool, [&](double rho, double underside, double ring_weight) {
      const bool in_bowl = std::isfinite(underside);
      if (std::abs(rho - radius) > 1e-12) {
        EXPECT_EQ(in_bowl, rho < radius) << rho;
      }
      if (in_bowl) {
        EXPECT_EQ(ring_weight, 0.0);
      }
      if (in_bowl && profile == ToolProfile::paper) {
        EXPECT_NEAR(underside,
                    radius / (2.0 * filter::u0) * std::sin(rho * rho / (radius * radius) * filter::u0),
                    1e-17);
      }
      if (rho < 0.1 * radius) {
        EXPECT_NEAR(underside, rho * rho / (2.0 * radius), 3e-3 * rho * rho / radius);
      }
      if (in_bowl && profile == ToolProfile::sphere) {
        // The sphere has rho^2 + (R - z)^2 = R^2; only this form keeps its digits at the rim.
        EXPECT_NEAR(rho * rho + std::pow(radius - underside, 2), radius * radius, 1e-18);
      }
    });
  }
}

TEST(ToolFootprint, LevelOfAPlaneIsItsHeightUnderTheToolAtAnySubCellPosition) {
  HeightField bed(200, 200, 0.001);
  for (int row = 0; row < 200; ++row)
    for (int col = 0; col < 200; ++col) bed.set(row, col, 0.3 * bed.x_of(col) - 0.2 * bed.y_of(row));
  SphereTool tool({radius, ToolProfile::paper});
  for (const double shift : {0.0, 0.25e-3, 0.5e-3, 0.9e-3}) {
    tool.place(bed, 0.01 + shift, 0.02 - shift);
    const double hundredth_of_a_cell = 0.01 * 0.001 * std::hypot(0.3, 0.2);
    EXPECT_NEAR(tool.sand_level(), 0.3 * (0.01 + shift) - 0.2 * (0.02 - shift), hundredth_of_a_cell);
  }
}

TEST(ToolFootprint, LevelHasNoJumpsWhileTheToolMoves) {
  HeightField bed(60, 60, 0.002);
  bed.set(30, 37, 0.005);  // one high cell, which the rim passes over
  SphereTool tool({radius, ToolProfile::paper});
  double last = 0.0;
  for (int i = 0; i <= 4000; ++i) {
    tool.place(bed, -0.02 + 1e-5 * i, 0.0);
    const double level = tool.sand_level();
    if (i > 0) {
      // The cell's weight changes at most by step / dx = 0.005 of about 1/160 of 5 mm.
      EXPECT_LT(std::abs(level - last), 1e-5 / 0.002 * 0.005 / 140.0);
    }
    last = level;
  }
}

TEST(ToolFootprint, IsEmptyOutsideTheBedAndHasNoLevel) {
  const HeightField bed(50, 50, 0.002);
  SphereTool tool({radius, ToolProfile::paper});
  for (const double far : {0.2, 1e300, -1e300, std::numeric_limits<double>::quiet_NaN()}) {
    tool.place(bed, far, 0.0);
    EXPECT_TRUE(tool.footprint().cells().empty());
    EXPECT_TRUE(std::isnan(tool.sand_level()));
  }
}

}  // namespace
}  // namespace sandstroke
