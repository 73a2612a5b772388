#include "haptics/stroke_quality.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace sandstroke {
namespace {

using Eigen::Vector3d;

/// A circle of 0.1 m drawn at 0.3 m/s for 4 s, sampled at 500 Hz, with noise [m rms] of the position.
Stroke noisy_circle(double noise, double jitter = 0.0) {
  std::mt19937 random(2);
  std::normal_distribution<double> normal(0.0, 1.0);
  Stroke stroke;
  for (int i = 0; i < 2000; ++i) {
    const double t = 0.002 * i + jitter * normal(random);
    stroke.time.push_back(t);
    const Vector3d shaken(normal(random), normal(random), normal(random));
    stroke.position.emplace_back(Vector3d(0.1 * std::cos(3.0 * t), 0.1 * std::sin(3.0 * t), 0.2) +
                                 noise / std::sqrt(3.0) * shaken);
  }
  return stroke;
}

TEST(StrokeQuality, FindsNoiseAndJitterWhateverTheMotion) {
  for (const double noise : {1e-6, 1e-4}) {
    EXPECT_NEAR(quality_of(noisy_circle(noise)).noise, noise, 0.06 * noise);
    EXPECT_NEAR(quality_of(noisy_circle(noise, 1e-4)).noise, noise, 0.06 * noise);
  }
  EXPECT_LT(quality_of(noisy_circle(0.0)).noise, 1e-8);
  EXPECT_LT(quality_of(noisy_circle(0.0)).jitter, 1e-12);
  EXPECT_NEAR(quality_of(noisy_circle(0.0, 1e-4)).jitter, std::sqrt(2.0) * 1e-4, 5e-6);  // of differences
}

TEST(StrokeQuality, MeasuresSpeedsExtentAndPlane) {
  const StrokeQuality quality = quality_of(noisy_circle(0.0));
  EXPECT_NEAR(quality.usual_speed, 0.3, 1e-4);
  EXPECT_NEAR(quality.top_speed, 0.3, 1e-4);
  EXPECT_LT((quality.extent - Vector3d(0.2, 0.2, 0.0)).norm(), 1e-4);
  EXPECT_NEAR(quality.plane.tilt(), 0.0, 1e-6);
  EXPECT_NEAR(quality.plane.rms(), 0.0, 1e-9);
  EXPECT_TRUE(quality_warnings(quality).empty());
}

TEST(StrokeQuality, EachThingThatMattersIsOneSentence) {
  const auto only_warning = [](const Stroke& stroke) {
    const std::vector<std::string> warnings = quality_warnings(quality_of(stroke));
    EXPECT_EQ(warnings.size(), 1u);
    return warnings.empty() ? "" : warnings[0];
  };
  Stroke wide = noisy_circle(0.0);
  for (Vector3d& p : wide.position) p *= 20.0;
  EXPECT_NE(only_warning(wide).find("4 m wide"), std::string::npos);

  Stroke held = noisy_circle(0.0);
  for (std::size_t i = 0; i < held.size(); ++i) held.position[i] = held.position[i - i % 3];
  EXPECT_NE(only_warning(held).find("67 % of its samples repeat"), std::string::npos);

  Stroke jump = noisy_circle(0.0);
  for (std::size_t i = 1000; i < jump.size(); ++i) jump.position[i].x() += 0.04;
  const std::string jumps = only_warning(jump);
  EXPECT_NE(jumps.find("jumps at 1.998 s at a speed of 20"), std::string::npos) << jumps;

  Stroke fast = noisy_circle(0.0);
  for (double& t : fast.time) t *= 0.001;
  EXPECT_NE(only_warning(fast).find("at up to 300 m/s"), std::string::npos) << only_warning(fast);
}

TEST(StrokeQuality, OneSampleHasNothingToMeasure) {
  Stroke one;
  one.time = {0.0};
  one.position = {Vector3d(1, 2, 3)};
  const StrokeQuality quality = quality_of(one);
  EXPECT_EQ(quality.noise, 0.0);
  EXPECT_EQ(quality.jitter, 0.0);
  EXPECT_TRUE(quality_warnings(quality).empty());
}

}  // namespace
}  // namespace sandstroke
