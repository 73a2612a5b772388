#include "haptics/stroke_sampler.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

namespace sandstroke {
namespace {

using Eigen::Vector3d;

/// A stroke with irregular times, rough and resting coordinates, and gaps of both kinds.
Stroke random_stroke(unsigned seed, std::size_t count) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  Stroke stroke;
  double time = 1.5;
  Vector3d position(0.1, -0.2, 0.3);
  for (std::size_t i = 0; i < count; ++i) {
    stroke.time.push_back(time);
    stroke.position.push_back(position);
    const double luck = uniform(random);
    stroke.contact.push_back(luck < 0.05 ? pen_up : luck < 0.1 ? pen_lifts : pen_down);
    time += uniform(random) < 0.03 ? 0.5 : 1e-4 + 0.03 * uniform(random);
    for (int axis = 0; axis < 3; ++axis) {
      if (uniform(random) < 0.7) position[axis] += 0.1 * (uniform(random) - 0.5);
    }
  }
  return stroke;
}

Stroke evenly_spaced(const std::vector<Vector3d>& points, double spacing) {
  Stroke stroke;
  stroke.position = points;
  for (std::size_t i = 0; i < points.size(); ++i) stroke.time.push_back(spacing * static_cast<double>(i));
  return stroke;
}

/// Distance [m] of a point from the straight line from a to b.
double distance_to(const Vector3d& point, const Vector3d& a, const Vector3d& b) {
  const double square = (b - a).squaredNorm();
  const double fraction = square > 0.0 ? std::clamp((point - a).dot(b - a) / square, 0.0, 1.0) : 0.0;
  return (point - a - fraction * (b - a)).norm();
}

TEST(StrokeSampler, NeverOvershootsAndNeverTouchesInAGap) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    const Stroke stroke = random_stroke(seed, 300);
    StrokeSampler sampler(stroke);
    for (std::size_t i = 0; i + 1 < stroke.size(); ++i) {
      const Vector3d &a = stroke.position[i], &b = stroke.position[i + 1];
      const double h = stroke.time[i + 1] - stroke.time[i];
      const bool inner = i > 0 && stroke.joined(i - 1) && i + 2 < stroke.size() && stroke.joined(i + 1);
      const Vector3d flat(1, 1, 0), flat_a = a.cwiseProduct(flat), flat_b = b.cwiseProduct(flat);
      double before = a.z();
      for (int k = 1; k < 50; ++k) {
        const Hand hand = sampler.at(stroke.time[i] + h * k / 50);
        ASSERT_EQ(hand.down, stroke.joined(i)) << "seed " << seed << " sample " << i;
        ASSERT_GE(hand.position.z(), std::min(a.z(), b.z()));
        ASSERT_LE(hand.position.z(), std::max(a.z(), b.z()));
        // Monotone from sample to sample, up to rounding.
        const double up = b.z() >= a.z() ? 1.0 : -1.0;
        ASSERT_GE(up * (hand.position.z() - before), -1e-15);
        before = hand.position.z();
        ASSERT_LE(distance_to(hand.position.cwiseProduct(flat), flat_a, flat_b),
                  (inner ? 1.0 / 3 : 2.0 / 3) * (flat_b - flat_a).norm() + 1e-15);
      }
    }
  }
}

TEST(StrokeSampler, TurnsAboutZAndReversesWithTheStroke) {
  const Stroke stroke = random_stroke(4, 200);
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.785, Vector3d::UnitZ()).toRotationMatrix();
  Stroke turned = stroke, reversed = stroke;
  for (Vector3d& p : turned.position) p = 2.0 * (turn * p) + Vector3d(1, 2, 3);
  reversed.contact = turned.contact = {};
  std::reverse(reversed.position.begin(), reversed.position.end());
  std::reverse(reversed.time.begin(), reversed.time.end());
  for (double& t : reversed.time) t = 100.0 - t;
  Stroke plain = stroke;
  plain.contact = {};
  StrokeSampler sampler(plain), sampler_turned(turned), sampler_reversed(reversed);
  for (int k = 1; k < 3000; ++k) {
    const double t = sampler.start_time() + (sampler.end_time() - sampler.start_time()) * k / 3000;
    const Hand hand = sampler.at(t), back = sampler_reversed.at(100.0 - t);
    EXPECT_LT((sampler_turned.at(t).position - (2.0 * (turn * hand.position) + Vector3d(1, 2, 3))).norm(),
              1e-13);
    EXPECT_LT((back.position - hand.position).norm(), 1e-11);
    EXPECT_LT((back.velocity + hand.velocity).norm(), 1e-9 * (1.0 + hand.velocity.norm()));
  }
}

/// The largest error of a way that is sampled `count` times in a second, away from its ends.
template <class Way>
double largest_error(const Way& way, int count) {
  Stroke stroke;
  for (int i = 0; i <= count; ++i) {
    stroke.time.push_back((i + 0.3 * std::sin(5.0 * i)) / count);  // uneven
    stroke.position.push_back(way(stroke.time.back()));
  }
  stroke.gap_threshold = 1.0;
  StrokeSampler sampler(stroke);
  double largest = 0.0;
  for (int k = 0; k <= 1000; ++k) {
    const double t = 0.25 + 0.5e-3 * k;
    largest = std::max(largest, (sampler.at(t).position - way(t)).norm());
  }
  return largest;
}

TEST(StrokeSampler, IsOfThirdOrderOnSmoothWays) {
  const auto circle = [](double t) { return Vector3d(std::cos(6.0 * t), std::sin(6.0 * t), 0.0); };
  const auto line = [](double t) -> Vector3d {
    return (t + 0.1 * std::sin(7.0 * t)) * Vector3d(0.6, 0.8, 0.0);
  };
  const auto check = [](const auto& way) {
    const double coarse = largest_error(way, 40), middle = largest_error(way, 80),
                 fine = largest_error(way, 320);
    EXPECT_GT(coarse / middle, 5.5);  // 2^3
    EXPECT_GT(middle / fine, 45.0);   // 4^3
  };
  check(circle);
  check(line);
  EXPECT_LT(largest_error(circle, 80), 1e-4);  // of the radius; by coordinates it was 2e-3
}

TEST(StrokeSampler, OnAStraightLineItGoesNeitherBackNorTooFarWhateverTheDirection) {
  const double way[] = {0.0, 1.0, 1.2, 4.0, 4.0, 4.5, 3.0, 3.0, -2.0, -2.1};
  const Vector3d along = Vector3d(3, -4, 0) / 5.0;
  Stroke stroke;
  for (std::size_t i = 0; i < std::size(way); ++i) {
    stroke.time.push_back(0.01 * static_cast<double>(i) + (i % 2 == 1 ? 0.004 : 0.0));
    stroke.position.push_back(way[i] * along);
  }
  StrokeSampler sampler(stroke);
  for (std::size_t i = 0; i + 1 < std::size(way); ++i) {
    double before = way[i];
    for (int k = 1; k <= 20; ++k) {
      const Vector3d p = sampler.at(std::lerp(stroke.time[i], stroke.time[i + 1], k / 20.0)).position;
      EXPECT_LT((p - p.dot(along) * along).norm(), 1e-14);
      EXPECT_GE((way[i + 1] >= way[i] ? 1.0 : -1.0) * (p.dot(along) - before), -1e-14) << i;
      before = p.dot(along);
      if (way[i] == way[i + 1]) {
        EXPECT_EQ(p, stroke.position[i]);
      }
    }
  }
}

TEST(StrokeSampler, ACornersVelocityIsTheParabolasAtMostOncePlusCosineTheSlowerSecant) {
  // Samples at t = 0, 1, 3 (x 0.01 s). Secants (1, 0) and (0, 1/2): the parabola's (2 (1, 0) + (0, 1/2)) / 3
  // is longer than the slower secant, 1/2; their angle is right. Then (1, 0) and (1, 1): (1, 1/3), within (1
  // + 0.71) 1.
  Stroke stroke;
  stroke.time = {0.0, 0.01, 0.03};
  stroke.position = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}};
  const Vector3d corner = StrokeSampler(stroke).at(0.01).velocity;
  EXPECT_LT((corner - 100.0 * 0.5 * Vector3d(2, 0.5, 0).normalized()).norm(), 1e-10);
  stroke.position[2] = {3, 2, 0};
  EXPECT_LT((StrokeSampler(stroke).at(0.01).velocity - 100.0 * Vector3d(1, 1.0 / 3, 0)).norm(), 1e-10);
  // The ends of (1, 0) and (0, 1/2): (4 (1, 0) - (0, 1/2)) / 3 and (5 (0, 1/2) - 2 (1, 0)) / 3.
  stroke.position[2] = {1, 1, 0};
  EXPECT_LT((StrokeSampler(stroke).at(0.0).velocity - 100.0 * Vector3d(4, -0.5, 0) / 3.0).norm(), 1e-10);
  EXPECT_LT((StrokeSampler(stroke).at(0.03).velocity - 100.0 * Vector3d(-2, 2.5, 0) / 3.0).norm(), 1e-10);
}

TEST(StrokeSampler, ReproducesItsSamplesToTheBit) {
  const Stroke stroke = random_stroke(7, 1000);
  StrokeSampler sampler(stroke);
  for (std::size_t i = 0; i < stroke.size(); ++i) {
    const Hand hand = sampler.at(stroke.time[i]);
    EXPECT_EQ(hand.position, stroke.position[i]) << i;
    EXPECT_EQ(hand.down, stroke.pen_down(i)) << i;
  }
}

TEST(StrokeSampler, AStraightLineAtConstantSpeedStaysOne) {
  const Vector3d velocity(0.1, -0.05, 0.01);
  Stroke stroke;
  std::mt19937 random(3);
  std::uniform_real_distribution<double> spacing(1e-3, 0.05);
  for (double t = 0.0; t < 2.0; t += spacing(random)) {
    stroke.time.push_back(t);
    stroke.position.push_back(t * velocity);
  }
  StrokeSampler sampler(stroke);
  for (double t = 0.0; t < sampler.end_time(); t += 0.001) {
    const Hand hand = sampler.at(t);
    EXPECT_LT((hand.position - t * velocity).norm(), 1e-15);
    EXPECT_LT((hand.velocity - velocity).norm(), 1e-13);
    EXPECT_TRUE(hand.down);
  }
}

/// A stroke that only moves in z.
Stroke upright(const std::vector<double>& times, const std::vector<double>& heights) {
  Stroke stroke;
  stroke.time = times;
  for (const double z : heights) stroke.position.emplace_back(0.0, 0.0, z);
  return stroke;
}

TEST(StrokeSampler, SlopesOfTheHeightAreThoseOfPchip) {
  // Samples at t = 0, 1, 2 (in units of 0.01 s). 0, 1, 3: secants 1 and 2. Inner slope: harmonic mean 4/3;
  // ends by the parabola: (3*1 - 2)/2 = 1/2 and (3*2 - 1)/2 = 5/2. 0, 1, 0: a turning point, inner slope 0;
  // ends (3*1
  // + 1)/2 = 2 and -2. 0, 1, 6: secants 1 and 5; end (3*1 - 5)/2 < 0 is set to 0; inner 2*5/6 = 5/3; end (15
  // - 1)/2 = 7. At t = 0, 1, 3, so h = 1, 2. Inner slope of secants a, b: 9 / (5/a + 4/b), the weights being
  // 2 h1 + h0 and h1 + 2 h0. Ends: (4 a - b) / 3 and (5 b - 2 a) / 3. Secants 1, 1/2: inner 9/13, ends 7/6
  // and 1/6. 1, 4: inner 9/6; 4 - 4 = 0 at the first end, 6 at the last. 2, 1/2: 9/10.5, 2.5 and 5/2 - 4 < 0,
  // which would turn: 0.
  struct Case {
    std::vector<double> times, heights, slopes;
  };
  for (const Case& one : {Case{{0, 1, 2}, {0, 1, 3}, {0.5, 4.0 / 3, 2.5}},
                          {{0, 1, 2}, {0, 1, 0}, {2, 0, -2}},
                          {{0, 1, 2}, {0, 1, 6}, {0, 5.0 / 3, 7}},
                          {{0, 1, 3}, {0, 1, 2}, {7.0 / 6, 9.0 / 13, 1.0 / 6}},
                          {{0, 1, 3}, {0, 1, 9}, {0, 1.5, 6}},
                          {{0, 1, 3}, {0, 2, 3}, {2.5, 9.0 / 10.5, 0}}}) {
    std::vector<double> times = one.times;
    for (double& t : times) t *= 0.01;
    StrokeSampler sampler(upright(times, one.heights));
    for (std::size_t i = 0; i < 3; ++i)
      EXPECT_NEAR(sampler.at(times[i]).velocity.z(), 100.0 * one.slopes[i], 1e-10) << i;
    // Halfway, a cubic Hermite is the mean of its ends plus h/8 of the difference of its slopes.
    for (std::size_t i = 0; i < 2; ++i)
      EXPECT_NEAR(sampler.at(0.5 * (times[i] + times[i + 1])).position.z(),
                  0.5 * (one.heights[i] + one.heights[i + 1]) +
                      (one.times[i + 1] - one.times[i]) / 8 * (one.slopes[i] - one.slopes[i + 1]),
                  1e-13);
  }
}

TEST(StrokeSampler, AnEndBeforeATurnIsNoSteeperThanThreeSecants) {
  // h = 1, 2 as above, secants 1 and -k: the end's slope is (4 + k) / 3, and 3 from k = 5 on. Where the
  // secants have one sign there is no such limit. The other end mirrors the first.
  for (const double k : {4.75, 5.25, 40.0, -0.5, -3.8}) {
    const double slope = std::min((4.0 + k) / 3.0, 3.0);
    for (const double sign : {1.0, -1.0}) {
      Stroke stroke = upright({0.0, 0.01, 0.03}, {0.0, sign, sign * (1.0 - 2.0 * k)});
      EXPECT_NEAR(StrokeSampler(stroke).at(0.0).velocity.z(), 100.0 * sign * slope, 1e-9) << k;
      std::swap(stroke.position.front(), stroke.position.back());
      stroke.time = {0.0, 0.02, 0.03};
      EXPECT_NEAR(StrokeSampler(stroke).at(0.03).velocity.z(), -100.0 * sign * slope, 1e-9) << k;
    }
  }
}

TEST(StrokeSampler, IsThePchipThatOthersPublish) {
  // NAG's example for e01bec (after Fritsch & Carlson's data RPN 14), to its four decimals.
  Stroke stroke;
  stroke.time = {7.99, 8.09, 8.19, 8.70, 9.20, 10.00, 12.00, 15.00, 20.00};
  for (const double f : {0.0, 0.27643e-4, 0.43750e-1, 0.16918, 0.46943, 0.94374, 0.99864, 0.99992, 0.99999})
    stroke.position.emplace_back(0.0, 0.0, 2.0 - f);
  stroke.gap_threshold = 10.0;
  StrokeSampler sampler(stroke);
  const double published[] = {0.0000, 0.4640, 0.9645, 0.9965, 0.9992, 0.9998,
                              0.9999, 1.0000, 1.0000, 1.0000, 1.0000};
  for (int i = 0; i <= 10; ++i) {
    const Vector3d at = sampler.at(std::min(7.99 + 1.201 * i, 20.0)).position;
    EXPECT_NEAR(at.z(), 2.0 - published[i], 5e-5) << i;
  }
}

TEST(StrokeSampler, SamplesAreJoinedUpToTheGapThreshold) {
  for (const double gap : {0.095, 0.105, 0.19, 0.21}) {
    Stroke stroke;
    stroke.time = {0.0, 0.01, 0.01 + gap, 0.02 + gap};
    stroke.position.assign(4, Vector3d::Zero());
    if (gap > 0.15) stroke.gap_threshold = 0.2;
    StrokeSampler sampler(stroke);
    const bool joined = gap < stroke.gap_threshold;
    EXPECT_EQ(sampler.gaps().empty(), joined) << gap;
    EXPECT_EQ(sampler.at(0.01 + 0.5 * gap).down, joined) << gap;
  }
}

TEST(StrokeSampler, VelocityIsTheDerivativeOfPosition) {
  StrokeSampler sampler(evenly_spaced({{0, 0, 0}, {1, 1, 1}, {3, 0, 6}, {4, 0, 6.5}}, 0.01));
  for (const double t : {0.003, 0.0141, 0.0277}) {
    const double dt = 1e-7;
    const Vector3d difference = sampler.at(t + dt).position - sampler.at(t - dt).position;
    EXPECT_LT((difference / (2 * dt) - sampler.at(t).velocity).norm(), 1e-5);
  }
}

TEST(StrokeSampler, DoesNotLookAcrossAGap) {
  Stroke stroke = evenly_spaced({{0, 0, 0}, {1, 0, 0}, {9, 9, 9}, {7, 7, 7}, {6, 6, 6}}, 0.01);
  stroke.contact = {pen_down, pen_lifts, pen_down, pen_down, pen_down};
  StrokeSampler sampler(stroke);
  EXPECT_NEAR(sampler.at(0.005).position.x(), 0.5, 1e-15);  // a piece of two samples is straight
  const Hand lifted = sampler.at(0.015);
  EXPECT_FALSE(lifted.down);
  EXPECT_LT((lifted.position - Vector3d(5, 4.5, 4.5)).norm(), 1e-12);
  EXPECT_LT((lifted.velocity - Vector3d(800, 900, 900)).norm(), 1e-9);
  EXPECT_TRUE(sampler.at(0.02).down);
  ASSERT_EQ(sampler.gaps().size(), 1u);
  EXPECT_EQ(sampler.gaps()[0].begin, 0.01);
  EXPECT_EQ(sampler.gaps()[0].end, 0.02);
}

TEST(StrokeSampler, FindsGapsOfBothKinds) {
  Stroke stroke;
  stroke.time = {0.0, 0.05, 0.25, 0.30, 0.35, 0.40, 0.80, 1.20};
  stroke.position.assign(8, Vector3d::Zero());
  stroke.contact = {1, 1, 1, 0, 0, 1, 1, 1};
  const StrokeSampler sampler(stroke);
  // Too far apart; lifted over two samples (one gap); too far apart on both sides of a point (two gaps).
  const std::vector<std::pair<double, double>> expected = {
      {0.05, 0.25}, {0.25, 0.40}, {0.40, 0.80}, {0.80, 1.20}};
  ASSERT_EQ(sampler.gaps().size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_EQ(sampler.gaps()[i].begin, expected[i].first);
    EXPECT_EQ(sampler.gaps()[i].end, expected[i].second);
  }
}

TEST(StrokeSampler, KnowsALiftBetweenAnyTwoTimes) {
  Stroke stroke = evenly_spaced({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {4, 0, 0}}, 0.01);
  stroke.contact = {pen_down, pen_lifts, pen_down, pen_down, pen_lifts};  // lifted from 0.01 to 0.02 s
  const StrokeSampler sampler(stroke);
  const auto lifts = [&](double begin, double end) { return sampler.lifts_between(begin, end); };
  EXPECT_FALSE(lifts(0.0, 0.01));
  EXPECT_TRUE(lifts(0.0, 0.011));
  EXPECT_TRUE(lifts(0.01, 0.02));
  EXPECT_TRUE(lifts(0.012, 0.015));
  EXPECT_TRUE(lifts(0.0, 0.04));
  EXPECT_FALSE(lifts(0.02, 0.04));
}

TEST(StrokeSampler, APieceOfOneSampleIsAPoint) {
  Stroke stroke =
      evenly_spaced({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, 1.0);  // all further apart than gap_threshold
  StrokeSampler sampler(stroke);
  EXPECT_TRUE(sampler.at(1.0).down);
  EXPECT_EQ(sampler.at(1.0).velocity, Vector3d::Zero());
  EXPECT_FALSE(sampler.at(1.0 - 1e-12).down);
  EXPECT_FALSE(sampler.at(1.0 + 1e-12).down);

  stroke.contact = {pen_down, pen_up, pen_down};
  StrokeSampler hovering(stroke);
  EXPECT_FALSE(hovering.at(1.0).down);
}

TEST(StrokeSampler, OneSampleIsEnough) {
  StrokeSampler sampler(evenly_spaced({{1, 2, 3}}, 1.0));
  EXPECT_EQ(sampler.start_time(), sampler.end_time());
  EXPECT_TRUE(sampler.at(0.0).down);
  EXPECT_EQ(sampler.at(0.0).position, Vector3d(1, 2, 3));
}

TEST(StrokeSampler, RestsLiftedOutsideItsTime) {
  StrokeSampler sampler(evenly_spaced({{0, 0, 0}, {1, 0, 0}}, 0.01));
  EXPECT_EQ(sampler.at(-1.0).position, Vector3d(0, 0, 0));
  EXPECT_FALSE(sampler.at(-1.0).down);
  EXPECT_TRUE(sampler.at(0.01).down);
  EXPECT_EQ(sampler.at(5.0).position, Vector3d(1, 0, 0));
  EXPECT_FALSE(sampler.at(5.0).down);
  EXPECT_EQ(sampler.at(5.0).velocity, Vector3d::Zero());
}

TEST(StrokeSampler, TheOrderOfCallsDoesNotMatter) {
  const Stroke stroke = random_stroke(11, 100);
  StrokeSampler forward(stroke), backward(stroke);
  std::vector<Hand> hands;
  const double step = (forward.end_time() - forward.start_time()) / 500;
  for (int k = 0; k <= 500; ++k) hands.push_back(forward.at(forward.start_time() + k * step));
  for (int k = 500; k >= 0; --k) {
    const Hand hand = backward.at(backward.start_time() + k * step);
    EXPECT_EQ(hand.position, hands[static_cast<std::size_t>(k)].position);
    EXPECT_EQ(hand.velocity, hands[static_cast<std::size_t>(k)].velocity);
    EXPECT_EQ(hand.down, hands[static_cast<std::size_t>(k)].down);
  }
}

Eigen::Quaterniond about_z(double angle) {
  return Eigen::Quaterniond(Eigen::AngleAxisd(angle, Vector3d::UnitZ()));
}

TEST(StrokeSampler, TurnsTheToolFromSampleToSampleByTheShortestWay) {
  Stroke stroke = evenly_spaced({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}}, 0.06);
  // A quaternion and its negative are one orientation; the third sample is a gap's end.
  for (const double angle : {0.2, 0.6, 0.6, -0.4}) stroke.orientation.push_back(about_z(angle).coeffs());
  stroke.orientation[1] *= -1.0;
  stroke.contact = {pen_down, pen_down, pen_lifts, pen_down};
  StrokeSampler sampler(stroke);
  const auto angle = [&](double t) {
    const Vector3d x = sampler.at(t).orientation * Vector3d::UnitX();
    return std::atan2(x.y(), x.x());
  };
  EXPECT_NEAR(angle(0.0), 0.2, 1e-12);
  EXPECT_NEAR(angle(0.03), 0.4, 1e-12);
  EXPECT_NEAR(angle(0.06), 0.6, 1e-12);
  EXPECT_NEAR(angle(0.1), 0.6, 1e-12);
  EXPECT_NEAR(angle(0.15), 0.1, 1e-12);
  for (const double after : {0.18, 1.0}) EXPECT_NEAR(angle(after), -0.4, 1e-12);
  EXPECT_NEAR(angle(-1.0), 0.2, 1e-12);
  for (double t = 0.0; t < 0.18; t += 0.007) EXPECT_NEAR(sampler.at(t).orientation.norm(), 1.0, 1e-15);

  Stroke not_turned = stroke;
  not_turned.orientation.clear();
  EXPECT_EQ(StrokeSampler(not_turned).at(0.03).orientation.coeffs(), Eigen::Vector4d(0, 0, 0, 1));
}

TEST(StrokeSampler, OrientationsConvergeAsTheSamplesAreMoreAtSecondOrder) {
  // A turn that speeds up and down, as a wrist does.
  const auto true_angle = [](double t) { return 1.2 * std::sin(3.0 * t) + 0.7 * t; };
  const auto worst = [&](int samples) {
    Stroke stroke =
        evenly_spaced(std::vector<Vector3d>(static_cast<std::size_t>(samples) + 1), 2.0 / samples);
    for (const double t : stroke.time) stroke.orientation.push_back(about_z(true_angle(t)).coeffs());
    StrokeSampler sampler(stroke);
    double error = 0.0;
    for (double t = 0.0; t < 2.0; t += 0.0007)
      error = std::max(error, sampler.at(t).orientation.angularDistance(about_z(true_angle(t))));
    return error;
  };
  EXPECT_LT(worst(40), 4e-3);
  EXPECT_NEAR(worst(80) / worst(160), 4.0, 0.4);
}

}  // namespace
}  // namespace sandstroke
