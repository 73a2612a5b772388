#include "measure/stroke_depth.h"

#include <gtest/gtest.h>

namespace sandstroke {
namespace {

/// A bed of 0.3 m x 0.2 m, and a stroke through these points, a second apart.
struct Played {
  Scene scene;
  Stroke stroke;

  explicit Played(const std::vector<Eigen::Vector3d>& points) {
    scene.bed.width = 0.3;
    scene.bed.depth = 0.2;
    scene.bed.cols = 150;
    scene.bed.rows = 100;
    stroke.position = points;
    for (std::size_t i = 0; i < points.size(); ++i) stroke.time.push_back(static_cast<double>(i));
  }
  HeightField bed() const { return starting_bed(scene.bed); }
  DeepestPoint deepest() const { return deepest_point(scene, bed(), stroke); }
  std::string warning() const { return depth_warning(scene, bed(), stroke, "stroke.h5"); }
};

TEST(StrokeDepth, IsThatOfTheLowestTip) {
  Played played({{0, 0, 0.02}, {0.01, 0, -0.006}, {0.02, 0, -0.004}});
  EXPECT_DOUBLE_EQ(played.deepest().depth, 0.006);
  EXPECT_EQ(played.deepest().time, 1.0);
  played.scene.device.offset = {0, 0, -0.001};
  EXPECT_DOUBLE_EQ(played.deepest().depth, 0.007);
}

TEST(StrokeDepth, CountsFromTheSandUnderTheTip) {
  Played played({{0, 0, 0.0}, {0.1, 0, -0.002}});
  played.scene.bed.surface.kind = SurfaceKind::cylinder;
  played.scene.bed.surface.radius = 0.05;
  played.scene.bed.surface.height = 0.04;
  EXPECT_DOUBLE_EQ(played.deepest().depth, 0.04);
  EXPECT_EQ(played.deepest().time, 0.0);
}

TEST(StrokeDepth, IsNoneInTheAirAndBesideTheBed) {
  Played played({{0, 0, 0.001}, {0.2, 0, -1.0}, {0, -0.11, -1.0}, {0, 0, -1.0}});
  played.stroke.contact = {pen_down, pen_down, pen_down, pen_up};
  EXPECT_EQ(played.deepest().depth, 0.0);
  EXPECT_EQ(played.warning(), "");
}

TEST(StrokeDepth, OverTwentyRadiiAreWarnedOf) {
  EXPECT_EQ(Played({{0, 0, -0.1999}}).warning(), "");
  const std::string warning = Played({{0, 0, 0.0}, {0, 0, -4.0}}).warning();
  EXPECT_TRUE(
      warning.starts_with("stroke.h5: goes 4 m deep into the sand (at 1.000 s), 400 times the tool's "
                          "reach of 0.01 m; "))
      << warning;
}

TEST(StrokeDepth, TwentyRadiiAreWhatIsWarnedOf) {
  for (const double radius : {0.004, 0.01}) {
    Played below({{0, 0, -19.0 * radius}}), above({{0, 0, -21.0 * radius}});
    below.scene.tool.radius = above.scene.tool.radius = radius;
    EXPECT_EQ(below.warning(), "");
    EXPECT_NE(above.warning(), "");
  }
}

TEST(StrokeDepth, SaysHowFarAToolStayedThatNeverTouched) {
  Played played({{0, 0, 0.02}});
  played.scene.stroke.emplace();
  played.scene.stroke->placement.depth = 0.001;
  played.scene.device.scale = 2.0;
  RunResult result;
  result.stroke.played = 1.0;
  result.least_beside = 0.25;
  const std::string beside = untouched_text(played.scene, result);
  EXPECT_NE(beside.find("250 mm or more beyond its edge; set stroke.place = \"centre\""), std::string::npos);
  result.nearest = -0.003;
  result.nearest_time = 0.25;
  const std::string text = untouched_text(played.scene, result);
  EXPECT_NE(text.find("3 mm above it (nearest at 0.250 s)"), std::string::npos) << text;
  EXPECT_NE(text.find("stroke.depth above 0.0025 m (it is 0.001 m)"), std::string::npos) << text;
  result.stroke.played = 0.0;
  EXPECT_NE(untouched_text(played.scene, result).find("never down"), std::string::npos);
}

}  // namespace
}  // namespace sandstroke
