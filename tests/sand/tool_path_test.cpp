#include "sand/tool_path.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace sandstroke {
namespace {

constexpr ToolSettings tool{0.01, ToolProfile::sphere};

TEST(ToolPath, HalfARadiusIsNoPath) {
  HeightField bed(100, 100, 0.002);
  ToolFootprint footprint(tool);
  EXPECT_EQ(displace_between(bed, footprint, {0.0, 0.0, -0.005}, {0.0049, 0.0, -0.02}, {}), 0.0);
  EXPECT_EQ(bed.touched_tiles(), 0);
}

TEST(ToolPath, IsWhatTicksInBetweenWouldDisplace) {
  const Eigen::Vector3d from(-0.02, 0.003, -0.002), to(0.03, -0.01, -0.007);
  const DisplacementSettings settings{Deposit::ahead};
  HeightField path(100, 100, 0.002), ticks(100, 100, 0.002);
  ToolFootprint footprint(tool);
  const double volume = displace_between(path, footprint, from, to, settings);

  const int steps = 11;  // 51.7 mm along the bed in steps of at most 5 mm
  double expected = 0.0;
  for (int i = 1; i < steps; ++i) {
    const Eigen::Vector3d tip = from + i / double{steps} * (to - from);
    footprint.place(ticks, tip.x(), tip.y());
    expected += displace(ticks, footprint, tip.z(), to - from, settings);
  }
  EXPECT_GT(expected, 0.0);
  EXPECT_EQ(volume, expected);
  EXPECT_TRUE((path.grid() == ticks.grid()).all());
  EXPECT_NEAR(path.volume(), 0.0, 1e-12 * volume);
}

TEST(ToolPath, InTheAirDisplacesNothing) {
  HeightField bed(100, 100, 0.002);
  ToolFootprint footprint(tool);
  EXPECT_EQ(displace_between(bed, footprint, {-0.05, 0.0, 0.001}, {0.05, 0.0, 0.001}, {}), 0.0);
  EXPECT_EQ(displace_between(bed, footprint, {-5.0, 3.0, -0.01}, {5.0, 3.0, -0.01}, {}),
            0.0);  // beside the bed
}

TEST(ToolPath, FromBeyondAllMeasureCostsOnlyWhatCrossesTheSand) {
  for (const double far : {1.0, 1e6, 1e20, 1e300}) {
    HeightField bed(100, 100, 0.002);
    ToolFootprint footprint(tool);
    const double volume =
        displace_between(bed, footprint, {-far, 0.0, -0.005}, {far, 0.0, -0.005}, {Deposit::ahead});
    EXPECT_TRUE(std::isfinite(volume));
    EXPECT_TRUE(bed.grid().isFinite().all());
    EXPECT_NEAR(bed.volume(), 0.0, 1e-12 * std::max(volume, 1e-9));
    if (far < 1e10) {
      EXPECT_LT(bed(49, 50), -0.003);
    }
  }
}

}  // namespace
}  // namespace sandstroke
