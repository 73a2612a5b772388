#include "view/pointer_path.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

namespace sandstroke {
namespace {

using Eigen::Vector3d;

constexpr std::int64_t millisecond = 1'000'000;  // ns
constexpr std::int64_t path_begin = 5'000 * millisecond;

/// The positions of the path, tick by tick, while each knot comes `lead` before it is due.
std::vector<Vector3d> followed(const std::vector<PointerKnot>& knots, std::int64_t lead, std::int64_t tick,
                               std::int64_t end) {
  PointerPath path(knots.front().tip, 17 * millisecond);
  std::vector<Vector3d> way;
  std::size_t next = 0;
  for (std::int64_t time = path_begin; time < end; time += tick) {
    for (; next < knots.size() && knots[next].time - lead <= time; ++next) path.add(knots[next]);
    way.push_back(path.at(time).tip);
  }
  return way;
}

Vector3d curve(double t) { return {std::exp(0.4 * t), std::sin(t) + 2.0 * t, 1.0 / (1.0 + t)}; }  // no turns
Vector3d circle(double t) { return {std::cos(t), std::sin(t), 0.0}; }

/// The largest error where samples are so far apart [s], however they lie to the hand's way, from 0.2 s on.
double error(const std::function<Vector3d(double)>& hand, double spacing) {
  double largest = 0.0;
  for (int phase = 0; phase < 8; ++phase) {
    const double shift = spacing * phase / 8.0;
    std::vector<PointerKnot> knots;
    for (double t = 0.0; t < 4.0; t += spacing)
      knots.push_back({path_begin + std::llround(1e9 * t), hand(t + shift), 0});
    const std::vector<Vector3d> way = followed(knots, static_cast<std::int64_t>(2.5e9 * spacing), millisecond,
                                               path_begin + 3000 * millisecond);
    for (std::size_t k = 200; k < way.size(); ++k)
      largest = std::max(largest, (way[k] - hand(1e-3 * static_cast<double>(k) + shift)).norm());
  }
  return largest;
}

TEST(PointerPath, ConvergesInThirdOrderAndInSecondWhereACoordinateTurns) {
  const double coarse = error(curve, 0.032), fine = error(curve, 0.016);
  EXPECT_NEAR(std::log2(coarse / fine), 3.0, 0.3);
  EXPECT_LT(fine, 1e-5);
  EXPECT_NEAR(std::log2(error(circle, 0.032) / error(circle, 0.016)), 2.0, 0.4);
}

TEST(PointerPath, IsSmoothInSpeedAndStaysBetweenItsKnots) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> position(-1.0, 1.0);
  std::uniform_int_distribution<std::int64_t> spacing(8 * millisecond, 30 * millisecond);
  std::vector<PointerKnot> knots;
  std::int64_t time = path_begin;
  for (int k = 0; k < 100; ++k, time += spacing(random))
    knots.push_back({time, {position(random), position(random), position(random)}, 0});
  constexpr std::int64_t tick = millisecond / 20;
  const std::vector<Vector3d> way = followed(knots, 70 * millisecond, tick, time);
  // No cubic bends more from knot to knot than 6 (|d| + |slopes|) / h, with slopes of at most 2 d.
  const double most_bend = 6.0 * (2.0 + 4.0) / (8e-3 * 8e-3) * 1.01, h = 1e-9 * tick;
  std::size_t knot = 0;
  for (std::size_t i = 1; i + 1 < way.size(); ++i) {
    EXPECT_LE(((way[i + 1] - 2.0 * way[i] + way[i - 1]) / (h * h)).cwiseAbs().maxCoeff(), most_bend);
    const std::int64_t now = path_begin + static_cast<std::int64_t>(i) * tick;
    while (knot + 1 < knots.size() && knots[knot + 1].time <= now) ++knot;
    if (knot + 1 == knots.size()) break;
    for (int axis = 0; axis < 3; ++axis) {
      const double a = knots[knot].tip[axis], b = knots[knot + 1].tip[axis];
      EXPECT_GE(way[i][axis], std::min(a, b) - 1e-12);
      EXPECT_LE(way[i][axis], std::max(a, b) + 1e-12);
    }
  }
}

TEST(PointerPath, ComesToRestAtTheLastKnotAndSetsOutOnlyWhenTheNextIsNear) {
  const std::vector<PointerKnot> knots = {{path_begin, {0.0, 0.0, 0.0}, 0},
                                          {path_begin + 20 * millisecond, {1.0, 0.0, 0.0}, 0},
                                          {path_begin + 500 * millisecond, {2.0, 0.0, 0.0}, 0},
                                          {path_begin + 520 * millisecond, {3.0, 0.0, 0.0}, 0}};
  const std::vector<Vector3d> way =
      followed(knots, 40 * millisecond, millisecond, path_begin + 600 * millisecond);
  EXPECT_EQ(way[20].x(), 1.0);
  for (int k = 20; k <= 483; ++k) ASSERT_EQ(way[static_cast<std::size_t>(k)].x(), 1.0) << k;
  EXPECT_GT(way[490].x(), 1.0);
  EXPECT_NEAR(way[500].x(), 2.0, 1e-12);
  EXPECT_EQ(way[520].x(), 3.0);
  EXPECT_EQ(way.back().x(), 3.0);
}

TEST(PointerPath, KnotsThatComeTooLateAreMadeUpForWithoutAJump) {
  std::vector<PointerKnot> knots;
  for (int k = 0; k < 30; ++k) knots.push_back({path_begin + k * 16 * millisecond, {0.1 * k, 0.0, 0.0}, 0});
  PointerPath path(knots.front().tip, 17 * millisecond);
  double before = 0.0, largest = 0.0;
  std::size_t next = 0;
  for (std::int64_t k = 0; k < 2000; ++k) {
    const bool late = k > 200 && k < 300;  // nothing comes for a while, then all at once
    for (;
         !late && next < knots.size() && knots[next].time - 40 * millisecond <= path_begin + k * millisecond;
         ++next)
      path.add(knots[next]);
    const double x = path.at(path_begin + k * millisecond).tip.x();
    largest = std::max(largest, x - before);
    EXPECT_GE(x, before);
    before = x;
  }
  EXPECT_NEAR(before, 2.9, 1e-12);
  EXPECT_LE(largest, 0.1 + 1e-12);  // in no tick more than from one knot to the next
}

TEST(PointerPath, SwitchesAreThoseOfTheKnotBefore) {
  PointerPath path(Vector3d::Zero(), 17 * millisecond);
  path.add({path_begin, {0, 0, 0}, 1});
  path.add({path_begin + 16 * millisecond, {0, 0, 0}, 2});
  EXPECT_EQ(path.at(path_begin - 30 * millisecond).switches, 0u);
  EXPECT_EQ(path.at(path_begin).switches, 1u);
  EXPECT_EQ(path.at(path_begin + 15 * millisecond).switches, 1u);
  EXPECT_EQ(path.at(path_begin + 16 * millisecond).switches, 2u);
}

}  // namespace
}  // namespace sandstroke
