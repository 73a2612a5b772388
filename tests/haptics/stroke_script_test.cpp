#include "haptics/stroke_script.h"

#include <gmock/gmock-matchers.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/angle.h"
#include "core/error.h"
#include "sanitized.h"

namespace sandstroke {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using testing::AllOf;
using testing::HasSubstr;

constexpr double pi = std::numbers::pi;

PressProfile depth(std::vector<double> values) { return {PressProfile::Kind::depth, std::move(values)}; }
PressProfile force(std::vector<double> values) { return {PressProfile::Kind::force, std::move(values)}; }

/// A script that starts at the first drawn point, so that it is plunge, drawing, lift. The plunge takes 0.5 s
/// for 10 mm of depth: 0.03 m at 0.06 m/s.
StrokeScript script_of(std::vector<ScriptSegment> segments) {
  StrokeScript script;
  script.name = "test.toml";
  script.clearance = 0.02;
  script.plunge_speed = 0.06;
  script.segments = std::move(segments);
  return script;
}

Vector3d at(const Stroke& stroke, double time) {
  return stroke.position[static_cast<std::size_t>(std::lround(time * stroke.nominal_rate))];
}

double top_speed(const Stroke& stroke) {
  double top = 0.0;
  for (std::size_t i = 1; i < stroke.size(); ++i)
    top = std::max(top, (stroke.position[i] - stroke.position[i - 1]).norm() * stroke.nominal_rate);
  return top;
}

std::string complaint(const StrokeScript& script) {
  try {
    trace_script(script, ForceSettings{});
  } catch (const Error& failure) {
    EXPECT_EQ(failure.kind(), ErrorKind::input);
    return failure.what();
  }
  return "";
}

TEST(StrokeScript, PlungesDrawsAndLifts) {
  const Stroke stroke = trace_script(script_of({{ScriptLine{{}, {0.2, 0.0}}, depth({0.01}), 0.1}}), {});
  // 0.03 m at 0.06 m/s, 0.2 m at 0.1 m/s, 0.03 m at 0.06 m/s.
  ASSERT_EQ(stroke.size(), 3001u);
  for (std::size_t i = 0; i < stroke.size(); ++i) EXPECT_EQ(stroke.time[i], static_cast<double>(i) / 1000.0);
  EXPECT_LT((at(stroke, 0.0) - Vector3d(0, 0, 0.02)).norm(), 1e-15);
  EXPECT_LT((at(stroke, 0.25) - Vector3d(0, 0, 0.005)).norm(), 1e-15);
  EXPECT_LT((at(stroke, 0.5) - Vector3d(0, 0, -0.01)).norm(), 1e-15);
  EXPECT_LT((at(stroke, 1.3) - Vector3d(0.08, 0, -0.01)).norm(), 1e-14);
  EXPECT_LT((at(stroke, 2.5) - Vector3d(0.2, 0, -0.01)).norm(), 1e-14);
  EXPECT_LT((at(stroke, 3.0) - Vector3d(0.2, 0, 0.02)).norm(), 1e-14);
  EXPECT_NEAR(top_speed(stroke), 0.1, 1e-12);
  EXPECT_EQ(stroke.nominal_rate, 1000.0);
}

TEST(StrokeScript, ReachesAnotherPositionLifted) {
  StrokeScript script = script_of({{ScriptLine{Vector2d(0.3, 0.4), {0.4, 0.4}}, depth({0.01}), 0.1}});
  script.travel_speed = 0.5;
  const Stroke stroke = trace_script(script, {});  // 0.5 m across at 0.5 m/s: 1 s in the air
  for (int i = 0; i <= 1000; ++i) {
    const Vector3d expected(0.3e-3 * i, 0.4e-3 * i, 0.02);
    EXPECT_LT((stroke.position[static_cast<std::size_t>(i)] - expected).norm(), 1e-15);
  }
  EXPECT_LT((at(stroke, 1.5) - Vector3d(0.3, 0.4, -0.01)).norm(), 1e-14);
}

TEST(StrokeScript, MoveLiftsAndTravels) {
  StrokeScript script = script_of({{ScriptLine{{}, {0.1, 0}}, depth({0.01}), 0.1}, {ScriptMove{{0.3, 0}}}});
  script.travel_speed = 0.4;
  const Stroke stroke = trace_script(script, {});
  // 0.5 plunge, 1 line, 0.5 lift, 0.5 travel, nothing left to lift.
  EXPECT_EQ(stroke.size(), 2501u);
  EXPECT_LT((at(stroke, 2.25) - Vector3d(0.2, 0, 0.02)).norm(), 1e-14);
  EXPECT_LT((stroke.position.back() - Vector3d(0.3, 0, 0.02)).norm(), 1e-15);
}

TEST(StrokeScript, ConsecutiveSegmentsAreDrawnWithoutLifting) {
  // A quarter circle from (0, 0) about (-0.1, 0), then on to the left: lifted only at the end.
  const Stroke stroke = trace_script(script_of({{ScriptArc{{-0.1, 0}, 0.1, 0, 90}, depth({0.01}), 0.1},
                                                {ScriptLine{{}, {-0.3, 0.1}}, depth({0.01}), 0.1}}),
                                     {});
  const double drawn = 0.1 * pi / 2 + 0.2;
  EXPECT_EQ(stroke.size(), static_cast<std::size_t>(std::ceil((1.0 + drawn / 0.1) * 1000)) + 1);
  for (double t = 0.5; t <= 0.5 + drawn / 0.1; t += 0.01) EXPECT_NEAR(at(stroke, t).z(), -0.01, 1e-15);
}

TEST(StrokeScript, AnArcIsExactAndRunsAtItsSpeed) {
  StrokeScript script =
      script_of({{ScriptArc{{0, 0}, 0.05, 30, -690}, depth({0.01}), 0.05}});  // two turns clockwise
  script.start = 0.05 * Vector2d(std::cos(pi / 6), std::sin(pi / 6));
  const Stroke stroke = trace_script(script, {});
  const double seconds = 4 * pi * 0.05 / 0.05;
  for (std::size_t i = 500; i <= 500 + static_cast<std::size_t>(seconds * 1000); ++i) {
    const double angle = pi / 6 - (stroke.time[i] - 0.5);  // 1 rad/s
    EXPECT_LT((stroke.position[i] - Vector3d(0.05 * std::cos(angle), 0.05 * std::sin(angle), -0.01)).norm(),
              1e-13);
  }
  EXPECT_EQ(stroke.size(), static_cast<std::size_t>(std::ceil((1.0 + seconds) * 1000)) + 1);
}

TEST(StrokeScript, DepthRunsThroughItsValues) {
  // Three values, on a line whose two halves slope by 3:4, so that speed in space is 5/4 of the speed across.
  StrokeScript script = script_of({{ScriptLine{{}, {0.16, 0}}, depth({0.01, 0.07, 0.01}), 0.1}});
  const Stroke stroke = trace_script(script, {});
  // Each half is 0.1 m long and takes 1 s.
  EXPECT_LT((at(stroke, 0.5) - Vector3d(0, 0, -0.01)).norm(), 1e-14);
  EXPECT_LT((at(stroke, 1.0) - Vector3d(0.04, 0, -0.04)).norm(), 1e-14);
  EXPECT_LT((at(stroke, 1.5) - Vector3d(0.08, 0, -0.07)).norm(), 1e-14);
  EXPECT_LT((at(stroke, 2.5) - Vector3d(0.16, 0, -0.01)).norm(), 1e-14);
  EXPECT_LE(top_speed(stroke), 0.1 + 1e-12);
}

TEST(StrokeScript, DepthIsSpreadOverTheWholeOfABentPath) {
  // An arc of length 0.1 pi with depth falling from 10 to 0 mm: half the depth in the middle.
  const Stroke stroke =
      trace_script(script_of({{ScriptArc{{-0.1, 0}, 0.1, 0, 180}, depth({0.01, 0.0}), 0.1}}), {});
  const double length = std::hypot(0.1 * pi, 0.01);  // of the helix
  for (double fraction = 0.0; fraction <= 1.0; fraction += 0.05) {
    const double t = 0.5 + fraction * length / 0.1;
    const auto i = static_cast<std::size_t>(std::floor(t * 1000));
    const double exact = (stroke.time[i] - 0.5) / (length / 0.1);
    if (exact < 0.0) continue;
    EXPECT_NEAR(stroke.position[i].z(), -0.01 * (1 - exact), 1e-14);
    EXPECT_NEAR(std::atan2(stroke.position[i].y(), stroke.position[i].x() + 0.1), pi * exact, 1e-12);
  }
}

TEST(StrokeScript, ForceIsPressedByItsDepth) {
  ForceSettings settings;
  settings.k_s = 500.0;
  settings.k_c = 2.0;
  StrokeScript script = script_of({{ScriptLine{{}, {0.1, 0}}, force({3.0}), 0.1}});
  script.plunge_speed = 100.0;  // done within a sample
  const Stroke stroke = trace_script(script, settings);
  EXPECT_NEAR(repulse_force(-at(stroke, 0.5).z(), settings), 3.0, 1e-12);
  EXPECT_NEAR(at(stroke, 0.5).z(), -std::log1p(3.0 / 500.0) / 2.0, 1e-15);

  // Values in between: exact at each of them.
  script.segments[0].press = force({4.0, 1.0});
  const Stroke falling = trace_script(script, settings);
  const auto lowest = std::min_element(falling.position.begin(), falling.position.end(),
                                       [](const Vector3d& a, const Vector3d& b) { return a.z() < b.z(); });
  EXPECT_NEAR(repulse_force(-lowest->z(), settings), 4.0, 0.01);
}

TEST(StrokeScript, ASplineRunsThroughItsPointsAtItsSpeed) {
  const std::vector<Vector2d> points = {{0, 0}, {0.05, 0.03}, {0.06, 0.08}, {0.2, 0.0}};
  StrokeScript script = script_of({{ScriptSpline{points}, depth({0.01}), 0.1}});
  script.rate = 10000.0;
  const Stroke stroke = trace_script(script, {});
  for (const Vector2d& point : points) {
    double nearest = 1.0;
    for (const Vector3d& p : stroke.position) nearest = std::min(nearest, (p.head<2>() - point).norm());
    EXPECT_LT(nearest, 1e-5);  // a sample every 1e-5 m
  }
  EXPECT_LE(top_speed(stroke), 0.1 + 1e-11);
  // The speed is all but reached between samples in the middle of the fine polyline.
  EXPECT_GT((stroke.position[8000] - stroke.position[7999]).norm() * 10000, 0.0999);
}

TEST(StrokeScript, ASplineThroughPointsOnALineIsThatLine) {
  const Stroke stroke = trace_script(
      script_of({{ScriptSpline{{{0, 0}, {0.02, 0.01}, {0.1, 0.05}, {0.12, 0.06}}}, depth({0.01}), 0.1}}), {});
  double before = 0.0;
  for (const Vector3d& p : stroke.position) {
    EXPECT_NEAR(p.y(), p.x() / 2, 1e-15);
    EXPECT_GE(p.x(), before - 1e-15);
    before = p.x();
  }
}

TEST(StrokeScript, ASplineIsTheCentripetalCatmullRom) {
  // The spline as cubic Hermite pieces, another way to write it: the slope at each inner point is
  // (P1 - P0) / a - (P2 - P0) / (a + b) + (P2 - P1) / b, with a = |P1 - P0|^(1/2) and b = |P2 - P1|^(1/2);
  // the points go on straight beyond the ends.
  const std::vector<Vector2d> points = {{0, 0}, {0.05, 0.03}, {0.06, 0.08}, {0.2, 0.0}};
  std::vector<Vector2d> all = points;
  all.insert(all.begin(), 2.0 * points[0] - points[1]);
  all.push_back(2.0 * points[3] - points[2]);
  const auto knot = [&](std::size_t i) { return std::sqrt((all[i + 1] - all[i]).norm()); };
  const auto slope = [&](std::size_t i) -> Vector2d {
    const double a = knot(i - 1), b = knot(i);
    return (all[i] - all[i - 1]) / a - (all[i + 1] - all[i - 1]) / (a + b) + (all[i + 1] - all[i]) / b;
  };
  std::vector<Vector2d> curve;
  for (std::size_t i = 1; i <= 3; ++i)
    for (int k = 0; k <= 4000; ++k) {
      const double u = k / 4000.0, h = knot(i);
      curve.push_back((1 + 2 * u) * (1 - u) * (1 - u) * all[i] + u * u * (3 - 2 * u) * all[i + 1] +
                      h * u * (1 - u) * ((1 - u) * slope(i) - u * slope(i + 1)));
    }
  const Stroke stroke = trace_script(script_of({{ScriptSpline{points}, depth({0.01}), 0.1}}), {});
  double farthest = 0.0;
  for (std::size_t i = 0; i < stroke.size(); i += 20) {
    double nearest = 1.0;
    for (const Vector2d& p : curve) nearest = std::min(nearest, (stroke.position[i].head<2>() - p).norm());
    farthest = std::max(farthest, nearest);
  }
  EXPECT_LT(farthest, 3e-5);  // half the way between two points of `curve`, at most 0.15 m / 4000
}

TEST(StrokeScript, TextGrowsWithItsHeight) {
  const auto width = [](double height) {
    const Stroke stroke = trace_script(
        script_of({{ScriptText{"WI", "futural", {0, 0}, height, 0.0, 0.3 * height}, depth({0.01}), 0.1}}),
        {});
    double right = 0.0;
    for (const Vector3d& p : stroke.position) right = std::max(right, p.x());
    return right;
  };
  EXPECT_NEAR(width(0.2), 2.0 * width(0.1), 1e-4);  // to a sample
}

TEST(StrokeScript, PressesUpToItsClearance) {
  for (const double fraction : {0.95, 1.05}) {
    const std::string sentence =
        complaint(script_of({{ScriptLine{{}, {0.1, 0}}, depth({0.01, -fraction * 0.02}), 0.1}}));
    EXPECT_EQ(sentence.empty(), fraction < 1.0) << sentence;
  }
}

TEST(StrokeScript, PressesByForceWhereAnySegmentDoes) {
  const ScriptSegment by_depth{ScriptLine{{}, {0.1, 0}}, depth({0.01})},
      by_force{ScriptLine{{}, {0.2, 0}}, force({1.0})};
  EXPECT_FALSE(presses_by_force(script_of({by_depth, by_depth})));
  EXPECT_TRUE(presses_by_force(script_of({by_depth, by_force})));
  EXPECT_TRUE(presses_by_force(script_of({by_force})));
  EXPECT_FALSE(presses_by_force(script_of({})));
}

TEST(StrokeScript, TheLetterIIsOneVerticalPenStroke) {
  ScriptText text{"I", "futural", {0.1, 0.2}, 0.07};
  const Stroke stroke = trace_script(script_of({{text, depth({0.01}), 0.1}}), {});
  double low = 1.0, high = -1.0, left = 1.0, right = -1.0;
  int plunges = 0;
  for (std::size_t i = 0; i < stroke.size(); ++i) {
    const Vector3d& p = stroke.position[i];
    plunges += i > 0 && p.z() < 0.0 && stroke.position[i - 1].z() >= 0.0;
    if (p.z() >= 0.0) continue;
    low = std::min(low, p.y());
    high = std::max(high, p.y());
    left = std::min(left, p.x());
    right = std::max(right, p.x());
  }
  EXPECT_EQ(plunges, 1);
  EXPECT_NEAR(low, 0.2, 1e-4);  // to a sample
  EXPECT_NEAR(high, 0.27, 1e-4);
  EXPECT_NEAR(left, right, 1e-14);
  EXPECT_GE(left, 0.1);
}

/// The sharpest turn [deg] of the pen while it draws a letter 0.4 m high, sampled every millimetre.
double sharpest_turn(const char* letter) {
  const Stroke stroke =
      trace_script(script_of({{ScriptText{letter, "futural", {0, 0}, 0.4}, depth({0.01}), 1.0}}), {});
  double sharpest = 0.0;
  for (std::size_t i = 2; i < stroke.size(); ++i) {
    const Vector3d before = stroke.position[i - 1] - stroke.position[i - 2],
                   after = stroke.position[i] - stroke.position[i - 1];
    const bool draws = stroke.position[i].z() == -0.01 && stroke.position[i - 2].z() == -0.01;
    if (draws && before.norm() > 0.0 && after.norm() > 0.0)
      sharpest = std::max(
          sharpest, to_degrees(std::acos(std::min(1.0, before.dot(after) / before.norm() / after.norm()))));
  }
  return sharpest;
}

// The font stores an S as 19 lines, which turn by up to 37 degrees.
TEST(StrokeScript, LettersHaveRoundCurvesAndSharpCorners) {
  for (const char* round : {"S", "C", "O", "a"}) EXPECT_LT(sharpest_turn(round), 8.0) << round;
  for (const char* angular : {"e"}) EXPECT_GT(sharpest_turn(angular), 60.0) << angular;
}

TEST(StrokeScript, TextTurnsAndSpacesItsLetters) {
  const auto x_of_last = [](double spacing, double angle) {
    const Stroke stroke = trace_script(
        script_of({{ScriptText{"II", "futural", {0, 0}, 0.07, angle, spacing}, depth({0.01}), 0.1}}), {});
    return stroke.position.back();
  };
  EXPECT_NEAR(x_of_last(0.03, 0).x() - x_of_last(0, 0).x(), 0.03, 1e-14);
  const Vector3d flat = x_of_last(0.01, 0), upright = x_of_last(0.01, 90);
  EXPECT_LT((upright - Vector3d(-flat.y(), flat.x(), flat.z())).norm(), 1e-14);
}

TEST(StrokeScript, WaitsAndRepeats) {
  StrokeScript script = script_of({{ScriptLine{Vector2d(0, 0), {0.1, 0}}, depth({0.01}), 0.1, 0.25}});
  script.travel_speed = 0.1;
  EXPECT_EQ(trace_script(script, {}).size(), 2251u);  // 0.5 + 1 + 0.25 + 0.5 s
  EXPECT_LT((at(trace_script(script, {}), 1.7) - Vector3d(0.1, 0, -0.01)).norm(), 1e-14);
  script.repeat = 2;
  EXPECT_EQ(trace_script(script, {}).size(), 2 * 2250u + 1000u + 1u);  // and 1 s back through the air
}

TEST(StrokeScript, SaysWhichSegmentCannotBeDrawn) {
  const ScriptSegment good{ScriptLine{{}, {0.1, 0}}, depth({0.01})};
  EXPECT_THAT(complaint(script_of({})), AllOf(HasSubstr("test.toml"), HasSubstr("no segments")));
  EXPECT_THAT(complaint(script_of({good, {ScriptLine{{}, {0.1, 0}}, depth({0.01})}})),
              AllOf(HasSubstr("test.toml: segment 2"), HasSubstr("no length")));
  EXPECT_THAT(complaint(script_of({{ScriptLine{{}, {0.1, 0}}, {}}})), HasSubstr("neither depth nor force"));
  EXPECT_THAT(complaint(script_of({{ScriptSpline{{{0, 0}, {1, 0}, {1, 0}}}, depth({0.01})}})),
              HasSubstr("points 2 and 3"));
  EXPECT_THAT(complaint(script_of({{ScriptText{"I", "nofont", {0, 0}, 0.1}, depth({0.01})}})),
              AllOf(HasSubstr("segment 1"), HasSubstr("nofont")));
  EXPECT_THAT(complaint(script_of({{ScriptText{"  ", "futural", {0, 0}, 0.1}, depth({0.01})}})),
              HasSubstr("draws nothing"));
  EXPECT_THAT(complaint(script_of({{ScriptLine{{}, {0.1, 0}}, depth({0.01, -0.03})}})),
              HasSubstr("clearance"));
  EXPECT_THAT(complaint(script_of({{ScriptLine{{}, {1e8, 0}}, depth({0.01})}})), HasSubstr("samples"));
  EXPECT_THAT(complaint(script_of({{ScriptLine{{}, {1e300, 1e300}}, depth({0.01})}})), HasSubstr("samples"));
}

TEST(StrokeScript, LongSplinesTakeNoMoreThanTheirStroke) {
  // 1000 points in zigzag, 20 m apart: legs of 0.1 mm would take 15 GB.
  ScriptSpline spline;
  for (int i = 0; i < 1000; ++i) spline.points.emplace_back(0.0, i % 2 * 20.0);
  StrokeScript script = script_of({{spline, depth({0.01}), 50.0}});
  script.rate = 20.0;
  const Stroke stroke = trace_script(script, {});
  EXPECT_NEAR(stroke.duration(), 1.0 + 999 * 20.0 / 50.0, 0.1);
}

TEST(StrokeScript, RefusesWorkWithoutEndThatGivesFewSamples) {
  if (sanitized) GTEST_SKIP() << "draws as much as is let through, a hundred times slower";
  // The path nearly stays on the spot, so its time says nothing of how much is drawn.
  ScriptSpline spline;
  for (int i = 0; i < 2000; ++i) spline.points.emplace_back(1e-12 * i, 0.0);
  StrokeScript script = script_of({{spline, depth({0.01}), 50.0}});
  script.repeat = 1000;
  EXPECT_THAT(complaint(script),
              AllOf(HasSubstr("segment 1"), HasSubstr("short lines"), HasSubstr("repeat")));
  script.segments = {{ScriptSpline{{{-1e308, 0}, {1e308, 0}}}, depth({0.01})}};
  EXPECT_THAT(complaint(script), HasSubstr("infinitely far"));
}

/// deg from +x towards +y, of where the tool's own axis points at a time.
double heading(const Stroke& stroke, double time, const Vector3d& axis = Vector3d::UnitX()) {
  const auto i = static_cast<std::size_t>(std::lround(time * stroke.nominal_rate));
  const Vector3d points = Eigen::Quaterniond(stroke.orientation[i]) * axis;
  return std::atan2(points.y(), points.x()) * 180.0 / pi;
}

TEST(StrokeScript, HasNoOrientationWithoutATurn) {
  EXPECT_TRUE(trace_script(script_of({{ScriptLine{{}, {0.1, 0}}, depth({0.01})}}), {}).orientation.empty());
}

TEST(StrokeScript, AToolThatFollowsThePathPointsAlongIt) {
  // A quarter of a circle to the left and one to the right, each from heading +y.
  for (const double end : {90.0, -90.0}) {
    const double side = end > 0 ? 1.0 : -1.0;
    ScriptSegment arc{ScriptArc{{-0.1 * side, 0}, 0.1, end > 0 ? 0.0 : 180.0, end > 0 ? 90.0 : 90.0},
                      depth({0.01}), 0.1};
    arc.turn.heading = ToolTurn::Heading::path;
    StrokeScript script = script_of({arc});
    const Stroke stroke = trace_script(script, {});
    // Turned by 90 deg in the air first: 0.5 s; then 0.5 s of plunge.
    const double drawn = 0.1 * pi / 2 / 0.1;
    for (const double fraction : {0.001, 0.3, 0.5, 0.99})
      EXPECT_NEAR(heading(stroke, 1.0 + fraction * drawn), 90.0 + side * 90.0 * fraction, 0.2);
    for (const Eigen::Vector4d& q : stroke.orientation) EXPECT_NEAR(q.norm(), 1.0, 1e-12);
  }
}

TEST(StrokeScript, TurnsTheToolAtACornerTheShorterWayWhereItStands) {
  ScriptSegment there{ScriptLine{{}, {-0.1, 0.001}}, depth({0.01}), 0.1};
  there.turn.heading = ToolTurn::Heading::path;
  ScriptSegment up{ScriptLine{{}, {-0.2, -0.099}}, depth({0.01}), 0.1};
  up.turn.heading = ToolTurn::Heading::path;
  StrokeScript script = script_of({there, up});
  script.turn_speed = 90.0;
  const Stroke stroke = trace_script(script, {});
  // 179.4 deg at the beginning, then on to -135 = 225 deg, by 45.6.
  const double begin = (180.0 - std::atan(0.01) * 180.0 / pi) / 90.0 + 0.5 + std::hypot(0.1, 0.001) / 0.1;
  EXPECT_NEAR(heading(stroke, begin + 0.25), 180.0 - 0.57 + 22.5 - 360.0, 0.2);
  EXPECT_LT((at(stroke, begin + 0.25) - Vector3d(-0.1, 0.001, -0.01)).norm(), 1e-9);
  EXPECT_NEAR(heading(stroke, begin + 0.6), -135.0, 0.2);
}

TEST(StrokeScript, ACornerOfUpToTenDegreesTakesNoTime) {
  for (const double corner : {9.5, 10.5}) {
    ScriptSegment ahead{ScriptLine{{}, {0.1, 0}}, depth({0.01}), 0.1};
    ScriptSegment on{
        ScriptLine{{}, {0.1 + 0.1 * std::cos(corner * pi / 180.0), 0.1 * std::sin(corner * pi / 180.0)}},
        depth({0.01}), 0.1};
    ahead.turn.heading = on.turn.heading = ToolTurn::Heading::path;
    StrokeScript script = script_of({ahead, on});
    script.turn_speed = 90.0;
    // Plunge and lift take 0.5 s each, the lines 1 s each.
    EXPECT_NEAR(trace_script(script, {}).duration(), 3.0 + (corner > 10.0 ? corner / 90.0 : 0.0), 2e-3)
        << corner;
  }
}

TEST(StrokeScript, TurnAndTiltRunThroughTheirValues) {
  ScriptSegment line{ScriptLine{{}, {0.2, 0}}, depth({0.01}), 0.1};
  line.turn.turn = {0.0, 60.0};
  line.turn.tilt = {0.0, 40.0, 0.0};
  const Stroke stroke = trace_script(script_of({line}), {});
  EXPECT_NEAR(heading(stroke, 1.0), 15.0, 0.1);
  EXPECT_NEAR(heading(stroke, 2.0), 45.0, 0.1);
  // It leans by 40 deg in the middle, its upper end towards its own +x.
  const Vector3d up = Eigen::Quaterniond(stroke.orientation[1500]) * Vector3d::UnitZ();
  EXPECT_NEAR(std::acos(up.z()) * 180.0 / pi, 40.0, 0.1);
  EXPECT_NEAR(heading(stroke, 1.5, Vector3d::UnitZ()), 30.0, 0.1);
}

}  // namespace
}  // namespace sandstroke
