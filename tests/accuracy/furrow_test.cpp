// A stronger push removes more sand, as the paper's figure 6 says.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>

#include "sim/simulation.h"

namespace sandstroke {
namespace {

constexpr double tip_depths[] = {0.002, 0.004, 0.006, 0.008, 0.010, 0.015, 0.020};  // m

/// Depth [m] of the furrow half-way along a drag of 0.3 m at 0.1 m/s, relaxed at 60 Hz: the mean over two
/// tool radii.
double furrow_depth(double tip_depth, Scene scene) {
  scene.bed.width = 0.4;
  scene.bed.depth = 0.2;
  scene.bed.cols = 200;
  scene.bed.rows = 100;
  Stroke stroke;
  stroke.gap_threshold = 10.0;
  stroke.time = {0.0, 0.5, 3.5};
  stroke.position = {{-0.15, 0.0, 0.01}, {-0.15, 0.0, -tip_depth}, {0.15, 0.0, -tip_depth}};
  Simulation simulation(scene, starting_bed(scene.bed), std::move(stroke));
  simulation.run();
  double sum = 0.0;
  for (int col = 95; col < 105; ++col) {
    double lowest = 0.0;
    for (int row = 40; row < 60; ++row) lowest = std::min(lowest, simulation.bed()(row, col));
    sum -= lowest;
  }
  return sum / 10.0;
}

std::vector<double> furrow_depths(const Scene& scene, const char* name) {
  std::vector<double> depths;
  for (const double tip_depth : tip_depths) depths.push_back(furrow_depth(tip_depth, scene));
  std::printf("%s: furrow", name);
  for (const double depth : depths) std::printf(" %.1f", 1e3 * depth);
  std::printf(" mm for tips at 2, 4, 6, 8, 10, 15, 20 mm\n");
  return depths;
}

TEST(Furrow, DeepensDownToARadiusWhereSandIsPushedAheadOrOutward) {
  Scene ahead, accurate;
  ahead.displacement.deposit = Deposit::ahead;
  accurate.preset = ModelPreset::accurate;
  apply_model_preset(accurate);
  for (const auto& [scene, name] : {std::pair(ahead, "ahead"), std::pair(accurate, "accurate")}) {
    const std::vector<double> depths = furrow_depths(scene, name);
    EXPECT_NEAR(depths[0], tip_depths[0], 0.1 * tip_depths[0]);  // a shallow one is as deep as the tip
    // Beyond a radius it hardly deepens: with ten cells per radius 5.1, 5.2 and 5.3 mm for 10, 15 and 20.
    for (std::size_t i = 1; i < depths.size(); ++i)
      EXPECT_GT(depths[i], (tip_depths[i] > 0.01 ? 0.97 : 1.0) * depths[i - 1]) << name << i;
  }
}

TEST(Furrow, PublishedRingFillsItsOwnFurrowBeyondFourMillimetres) {
  const std::vector<double> depths = furrow_depths(Scene{}, "ring");
  EXPECT_GT(depths[1], depths[0]);  // figure 6 holds up to here
  for (std::size_t i = 2; i < depths.size(); ++i) EXPECT_LT(depths[i], depths[1]) << i;
  EXPECT_LT(depths.back(), 0.5 * depths[1]);
}

}  // namespace
}  // namespace sandstroke
