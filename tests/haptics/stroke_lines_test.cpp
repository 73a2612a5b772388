#include "haptics/stroke_lines.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "haptics/stroke_sampler.h"

namespace sandstroke {
namespace {

using Eigen::Vector3d;

constexpr double line_tolerance = 1e-5;  // m

/// Lines with these ends at these speeds, joined whatever their time.
Stroke lines_through(const std::vector<Vector3d>& ends, const std::vector<double>& speeds) {
  Stroke stroke;
  stroke.position = ends;
  stroke.time = {0.0};
  for (std::size_t i = 0; i + 1 < ends.size(); ++i)
    stroke.time.push_back(stroke.time.back() + (ends[i + 1] - ends[i]).norm() / speeds[i % speeds.size()]);
  stroke.gap_threshold = 1.0 + stroke.duration();
  return stroke;
}

/// The largest distance [m] between a line's point and the sampled curve's at equal times: so in shape and in
/// speed.
double largest_distance(const Stroke& lines, StrokeSampler sampler) {
  double largest = 0.0;
  for (std::size_t i = 0; i + 1 < lines.size(); ++i) {
    for (int k = 0; k <= 4000; ++k) {
      const double fraction = 1e-6 + (1.0 - 2e-6) * k / 4000.0;
      const double fine = k % 2 ? fraction : fraction * fraction * fraction;  // corners are short
      for (const double s : {fine, 1.0 - fine}) {
        const double t = std::lerp(lines.time[i], lines.time[i + 1], s);
        const Vector3d p = lines.position[i] + s * (lines.position[i + 1] - lines.position[i]);
        largest = std::max(largest, (sampler.at(t).position - p).norm());
      }
    }
  }
  return largest;
}

double leaves_by(const std::vector<Vector3d>& ends, const std::vector<double>& speeds = {0.03}) {
  const Stroke lines = lines_through(ends, speeds);
  Stroke kept = lines;
  keep_lines_straight(kept, line_tolerance);
  check_stroke(kept, "kept");
  return largest_distance(lines, StrokeSampler(kept));
}

TEST(StrokeLines, ASquareKeepsItsCorners) {
  const std::vector<Vector3d> square = {{0, 0, 0}, {0.12, 0, 0}, {0.12, 0.12, 0}, {0, 0.12, 0}, {0, 0, 0}};
  EXPECT_GT(largest_distance(lines_through(square, {0.03}), StrokeSampler(lines_through(square, {0.03}))),
            5e-3);  // what the curve alone does
  EXPECT_LE(leaves_by(square), line_tolerance);
}

TEST(StrokeLines, HeightsAndSpeedsHaveCornersToo) {
  EXPECT_LE(leaves_by({{0, 0, 0.01}, {0.1, 0, 0.01}, {0.2, 0, -0.01}, {0.3, 0, -0.01}}), line_tolerance);
  EXPECT_LE(leaves_by({{0, 0, 0}, {0.1, 0, 0}, {0.2, 0, 0}, {0.1, 0, 0}}, {0.01, 0.5, 0.02}), line_tolerance);
}

TEST(StrokeLines, RandomLinesOfAnyLength) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (int n = 0; n < 20; ++n) {
    std::vector<Vector3d> ends = {Vector3d::Zero()};
    std::vector<double> speeds;
    for (int i = 0; i < 12; ++i) {
      const double length = std::pow(10.0, -3.0 + 2.0 * uniform(random));
      ends.push_back(ends.back() + length * Vector3d(uniform(random), uniform(random), uniform(random)));
      speeds.push_back(std::pow(10.0, -1.0 + uniform(random)));
    }
    EXPECT_LE(leaves_by(ends, speeds), line_tolerance) << n;
  }
}

/// Chords that are off a circle by a quarter of the tolerance: they stand for it, and the curve is better.
TEST(StrokeLines, FineChordsOfACircleStay) {
  const double radius = 0.1;
  const int count =
      static_cast<int>(2.0 * std::numbers::pi / std::sqrt(8.0 * 0.25 * line_tolerance / radius));
  std::vector<Vector3d> ends;
  for (int i = 0; i <= count; ++i)
    ends.emplace_back(radius * std::cos(2.0 * std::numbers::pi * i / count),
                      radius * std::sin(2.0 * std::numbers::pi * i / count), 0.0);
  Stroke stroke = lines_through(ends, {0.03});
  keep_lines_straight(stroke, line_tolerance);
  EXPECT_EQ(stroke.size(), ends.size());
}

TEST(StrokeLines, OnlyJoinedLinesGetSamplesAndOtherColumnsChangeEvenly) {
  Stroke stroke = lines_through({{0, 0, 0}, {0.1, 0, 0}, {0.1, 0.1, 0}, {0.2, 0.1, 0}}, {0.1});
  stroke.contact = {pen_down, pen_lifts, pen_down, pen_down};
  stroke.pressure = {0.0, 1.0, 2.0, 3.0};
  const Stroke before = stroke;
  keep_lines_straight(stroke, line_tolerance);
  EXPECT_EQ(stroke.size(), 4u);  // each piece is one line

  stroke = before;
  stroke.contact[1] = pen_down;
  keep_lines_straight(stroke, line_tolerance);
  ASSERT_EQ(stroke.size(), 8u);  // two corners
  for (std::size_t i = 0; i < stroke.size(); ++i) EXPECT_NEAR(stroke.pressure[i], stroke.time[i], 1e-12);
}

}  // namespace
}  // namespace sandstroke
