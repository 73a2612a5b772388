#include "haptics/stroke_smoothing.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "core/error.h"

namespace sandstroke {
namespace {

using Eigen::Vector3d;

/// Samples of a sine along a direction, at a mean rate [Hz], from 0 to 4 s; jitter is a fraction of the
/// spacing.
Stroke sine(double frequency, double rate, double jitter = 0.0) {
  Stroke stroke;
  std::mt19937 random(5);
  std::uniform_real_distribution<double> off(-0.5 * jitter, 0.5 * jitter);
  for (int i = 0; i <= 4 * rate; ++i) {
    const double t = (i + off(random)) / rate;
    stroke.time.push_back(t);
    stroke.position.emplace_back(Vector3d(2, -1, 3) * std::sin(2.0 * std::numbers::pi * frequency * t));
  }
  return stroke;
}

/// Amplitudes of a smoothed sine, away from its ends, by least squares: in phase and a quarter behind.
Eigen::Vector2d gain(const Stroke& smooth, double frequency) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  double squares = 0.0;
  for (std::size_t i = 0; i < smooth.size(); ++i) {
    const double t = smooth.time[i];
    if (t < 1.0 || t >= 3.0) continue;
    const double phase = 2.0 * std::numbers::pi * frequency * t;
    sum += Eigen::Vector2d(std::sin(phase), std::cos(phase)) * smooth.position[i].x() / 2.0;
    squares += std::sin(phase) * std::sin(phase);
  }
  return sum / squares;
}

TEST(StrokeSmoothing, HalvesASineAtTheCutOffWithoutPhaseShift) {
  for (const double rate : {100.0, 1000.0}) {
    const Eigen::Vector2d half = gain(smoothed(sine(10.0, rate), 10.0), 10.0);
    EXPECT_NEAR(half[0], 0.5, 1e-3) << rate;
    EXPECT_NEAR(half[1], 0.0, 1e-3) << rate;
  }
  // 1 / (1 + (f / cut-off)^4), also between uneven times.
  for (const double frequency : {3.0, 5.0, 8.0, 10.0, 20.0}) {
    const double ratio = frequency / 8.0;
    const Eigen::Vector2d found = gain(smoothed(sine(frequency, 500.0, 0.6), 8.0), frequency);
    EXPECT_NEAR(found[0], 1.0 / (1.0 + std::pow(ratio, 4)), 0.01) << frequency;
    EXPECT_NEAR(found[1], 0.0, 0.01) << frequency;
  }
}

TEST(StrokeSmoothing, AUniformStraightMotionAndTheEndsOfPiecesStay) {
  Stroke line = sine(0.0, 200.0, 0.8);
  for (std::size_t i = 0; i < line.size(); ++i)
    line.position[i] = Vector3d(1, 2, 3) * (0.1 * line.time[i] - 4.0);
  line.velocity.assign(line.size(), Vector3d(0.1, 0.2, 0.3));
  for (const double cut_off : {0.5, 5.0, 90.0}) {
    const Stroke smooth = smoothed(line, cut_off);
    for (std::size_t i = 0; i < line.size(); ++i) {
      EXPECT_LT((smooth.position[i] - line.position[i]).norm(), 1e-9) << cut_off;
      EXPECT_LT((smooth.velocity[i] - line.velocity[i]).norm(), 1e-9) << cut_off;
    }
  }
  Stroke shaken = sine(30.0, 200.0);
  shaken.contact.assign(shaken.size(), pen_down);
  shaken.contact[300] = pen_lifts;
  const Stroke smooth = smoothed(shaken, 5.0);
  for (const std::size_t i : {std::size_t{0}, std::size_t{300}, std::size_t{301}, shaken.size() - 1})
    EXPECT_EQ(smooth.position[i], shaken.position[i]) << i;
  EXPECT_LT(smooth.position[150].norm(), 0.01 * 3.8);
}

TEST(StrokeSmoothing, PiecesKnowNothingOfEachOther) {
  Stroke both = sine(12.0, 200.0), first = both;
  both.contact.assign(both.size(), pen_down);
  both.contact[200] = pen_lifts;
  for (std::size_t i = 201; i < both.size(); ++i) both.position[i] += Vector3d(9, 9, 9);
  first.time.resize(201);
  first.position.resize(201);
  const Stroke smooth = smoothed(both, 6.0), alone = smoothed(first, 6.0);
  for (std::size_t i = 0; i <= 200; ++i) EXPECT_EQ(smooth.position[i], alone.position[i]);
}

TEST(StrokeSmoothing, TurnsShiftsScalesAndReversesWithTheStroke) {
  Stroke stroke = sine(7.0, 100.0, 0.5);
  for (std::size_t i = 0; i < stroke.size(); ++i) stroke.position[i].y() += std::cos(9.0 * stroke.time[i]);
  const Stroke smooth = smoothed(stroke, 4.0);
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.8, Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  Stroke moved = stroke, reversed = stroke;
  for (Vector3d& p : moved.position) p = 3.0 * (turn * p) + Vector3d(1, 2, 3);
  std::reverse(reversed.position.begin(), reversed.position.end());
  std::reverse(reversed.time.begin(), reversed.time.end());
  for (double& t : reversed.time) t = 4.1 - t;
  const Stroke smooth_moved = smoothed(moved, 4.0), smooth_reversed = smoothed(reversed, 4.0);
  for (std::size_t i = 0; i < stroke.size(); ++i) {
    const Vector3d expected = 3.0 * (turn * smooth.position[i]) + Vector3d(1, 2, 3);
    EXPECT_LT((smooth_moved.position[i] - expected).norm(), 1e-9);
    EXPECT_LT((smooth_reversed.position[stroke.size() - 1 - i] - smooth.position[i]).norm(), 1e-9);
  }
}

TEST(StrokeSmoothing, WhatIsSampledTooRarelyStays) {
  const Stroke stroke = sine(3.0, 20.0);
  EXPECT_EQ(smoothed(stroke, 10.5).position, stroke.position);
  EXPECT_NE(smoothed(stroke, 9.5).position, stroke.position);
}

/// The same motion at two rates, down to the lowest cut-off: rounding grows with the fourth power of the
/// rate.
TEST(StrokeSmoothing, LowCutOffsAreExactAtHighRatesOrRefused) {
  for (const double cut_off : {0.17, 0.3, 1.0, 3.0}) {
    const Stroke coarse = smoothed(sine(cut_off, 50.0), cut_off),
                 fine = smoothed(sine(cut_off, 1000.0), cut_off);
    for (std::size_t i = 0; i < coarse.size(); ++i)
      ASSERT_LT((coarse.position[i] - fine.position[20 * i]).norm(), 2e-3 * 3.8) << cut_off << " Hz, " << i;
  }
  EXPECT_THROW(smoothed(sine(1.0, 1000.0), 0.15), Error);
  EXPECT_NO_THROW(smoothed(sine(1.0, 50.0), 0.15));
}

}  // namespace
}  // namespace sandstroke
