// How deep a tool is in a floor, and which way it leaves it by the least way.
#include "sand/floor_contact.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "core/angle.h"
#include "sand/ground.h"

namespace sandstroke {
namespace {

using Eigen::Vector3d;
constexpr double ball = 0.006;  // m, the tool's radius

/// A bed of 0.12 m without sand above z = -1 whose floor is floor_of(x, y) [m].
template <class FloorOf>
HeightField bed_on(double cell, const FloorOf& floor_of) {
  const int cells = static_cast<int>(std::lround(0.12 / cell));
  HeightField bed(cells, cells, cell);
  const auto ground = std::make_shared<Ground>(bed, 0.6);
  for (int row = 0; row < cells; ++row)
    for (int col = 0; col < cells; ++col) ground->floor.set(row, col, floor_of(bed.x_of(col), bed.y_of(row)));
  bed.lie_on(ground);
  return bed;
}

ToolSettings ball_tool() { return {.radius = ball}; }
Vector3d way_of_ball(const HeightField& bed, const Vector3d& centre) {
  return FloorContact(ball_tool(), bed.cell_size()).way_out(bed, centre - Vector3d(0.0, 0.0, ball));
}
void expect_near(const Vector3d& a, const Vector3d& b, double tolerance) {
  EXPECT_LE((a - b).norm(), tolerance) << a.transpose() << " for " << b.transpose();
}

TEST(FloorContact, IsNoneWithoutGroundOrAboveIt) {
  const HeightField nothing(60, 60, 0.002);
  EXPECT_TRUE(way_of_ball(nothing, {0.0, 0.0, -1.0}).isZero(0.0));
  HeightField bed = nothing;
  bed.lie_on(std::make_shared<Ground>(bed, 0.6));
  EXPECT_TRUE(way_of_ball(bed, {0.0, 0.0, -1.0}).isZero(0.0)) << "a ground without floor";
  bed.lie_on(std::make_shared<Ground>(bed, -0.01, 0.6));
  EXPECT_TRUE(way_of_ball(bed, {0.0, 0.0, -0.01 + ball}).isZero(0.0)) << "it just touches";
  expect_near(way_of_ball(bed, {0.0, 0.0, -0.01 + 0.75 * ball}), {0.0, 0.0, 0.25 * ball}, 1e-15);
}

TEST(FloorContact, IsExactOnPlanesAtAnyHeightAndTilt) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> real(-1.0, 1.0);
  for (int i = 0; i < 200; ++i) {
    const double level = 0.03 * real(random), to_x = 1.2 * real(random), to_y = 1.2 * real(random);
    const HeightField bed = bed_on(0.002, [&](double x, double y) { return level + to_x * x + to_y * y; });
    const Vector3d normal = Vector3d(-to_x, -to_y, 1.0).normalized();
    const double x = 0.03 * real(random), y = 0.03 * real(random), depth = ball * (1.0 + real(random)) + 1e-9;
    const Vector3d centre = Vector3d(x, y, level + to_x * x + to_y * y) + (ball - depth) * normal;
    expect_near(way_of_ball(bed, centre), depth * normal, 1e-12);
  }
}

/// A box with upright sides at x, y = +-0.02 m, 0.03 m high, on a floor at z = 0, or on none.
double box_stone(double x, double y, double around) {
  return std::abs(x) < 0.02 && std::abs(y) < 0.02 ? 0.03 : around;
}

TEST(FloorContact, IsPushedSidewaysByAnUprightSide) {
  for (const double around : {0.0, -std::numeric_limits<double>::infinity()}) {
    const HeightField bed = bed_on(0.002, [&](double x, double y) { return box_stone(x, y, around); });
    for (const double depth : {1e-6, 0.001, 0.9 * ball, 1.5 * ball}) {
      const double out = 0.02 + ball - depth;
      expect_near(way_of_ball(bed, {out, 0.0031, 0.012}), {depth, 0.0, 0.0}, 1e-12);
      expect_near(way_of_ball(bed, {-0.0017, -out, 0.012}), {0.0, -depth, 0.0}, 1e-12);
    }
    EXPECT_TRUE(way_of_ball(bed, {0.02 + ball, 0.0, 0.012}).isZero(0.0));
    // At the upper edge: away from it.
    const Vector3d off = Vector3d(0.6, 0.0, 0.8) * (ball - 0.001);
    expect_near(way_of_ball(bed, Vector3d(0.02, 0.0, 0.03) + off), 0.001 * Vector3d(0.6, 0.0, 0.8), 1e-12);
  }
}

TEST(FloorContact, LeavesACornerAwayFromBothSides) {
  const HeightField bed = bed_on(0.002, [&](double x, double y) { return box_stone(x, y, 0.0); });
  for (const double in_side : {0.0003, 0.001, 0.002})
    for (const double in_floor : {0.0004, 0.001, 0.0017})
      expect_near(way_of_ball(bed, {0.02 + ball - in_side, 0.003, ball - in_floor}), {in_side, 0.0, in_floor},
                  1e-9);
}

/// The largest error of the way out of a sphere of 0.02 m, from its top to 50 degrees beside it.
double error_on_sphere(double cell) {
  constexpr double stone = 0.02;
  const HeightField bed = bed_on(cell, [&](double x, double y) {
    const double square = stone * stone - x * x - y * y;
    return square > 0.0 ? std::sqrt(square) : -std::numeric_limits<double>::infinity();
  });
  double largest = 0.0;
  for (int tilt = 0; tilt <= 50; tilt += 5)
    for (int turn = 0; turn < 360; turn += 7) {
      const double t = to_radians(tilt), a = to_radians(turn), depth = 0.001;
      const Vector3d out(std::sin(t) * std::cos(a), std::sin(t) * std::sin(a), std::cos(t));
      const Vector3d way = way_of_ball(bed, (stone + ball - depth) * out);
      largest = std::max(largest, (way - depth * out).norm());
    }
  return largest;
}

TEST(FloorContact, ConvergesOnASphereOfCells) {
  const double coarse = error_on_sphere(0.002), middle = error_on_sphere(0.001),
               fine = error_on_sphere(0.0005);
  EXPECT_LT(coarse, 0.25 * 0.002);
  EXPECT_LT(middle, 0.5 * coarse);
  EXPECT_LT(fine, 0.25 * coarse);
  EXPECT_LT(fine, 0.05 * 0.0005);
}

TEST(FloorContact, ChangesContinuouslyAndVanishesWhereNothingTouches) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> real(-1.0, 1.0);
  constexpr double cell = 0.002;
  HeightField bed = bed_on(cell, [&](double x, double y) {
    const double square = 0.015 * 0.015 - (x + 0.03) * (x + 0.03) - y * y;
    return std::max({0.0, box_stone(x - 0.02, y, 0.0), square > 0.0 ? 0.01 + std::sqrt(square) : 0.0});
  });
  ToolSettings plate{.shape = ToolShape::plate, .height = 0.02, .width = 0.02, .thickness = 0.006};
  for (const ToolSettings& tool : {ball_tool(), plate}) {
    FloorContact contact(tool, cell);
    double longest = 0.0;
    for (int line = 0; line < 20; ++line) {
      // Not deep: at the middle of a stone both of its sides are as near.
      const Vector3d from(0.05 * real(random), 0.05 * real(random), 0.002 + 0.03 * std::abs(real(random)));
      const Vector3d step = 2e-6 * Vector3d(real(random), real(random), 0.2 * real(random));
      Vector3d before = contact.way_out(bed, from);
      for (int i = 1; i <= 1500; ++i) {
        const Vector3d way = contact.way_out(bed, from + i * step);
        if (way.norm() < 0.5 * ball && before.norm() < 0.5 * ball)
          longest = std::max(longest, (way - before).norm());
        before = way;
      }
    }
    EXPECT_LT(longest, cell);
  }
}

TEST(FloorContact, OfAPlateIsSidewaysAtAnUprightSideAndUpOnALevelFloor) {
  const HeightField bed = bed_on(0.002, [&](double x, double y) { return box_stone(x, y, 0.0); });
  ToolSettings plate{.shape = ToolShape::plate, .height = 0.02, .width = 0.02, .thickness = 0.006};
  FloorContact contact(plate, 0.002);
  for (const double depth : {0.0002, 0.001, 0.0025}) {
    expect_near(contact.way_out(bed, {-0.023 + depth, 0.0, 0.005}), {-depth, 0.0, 0.0}, 1e-9);
    expect_near(contact.way_out(bed, {-0.04, 0.0, -depth}), {0.0, 0.0, depth}, 1e-9);
  }
  EXPECT_TRUE(contact.way_out(bed, {-0.0231, 0.0, 0.0001}).isZero(0.0));
  contact.turn(Eigen::AngleAxisd(0.5 * M_PI, Vector3d::UnitZ()).toRotationMatrix());  // 0.02 along x
  expect_near(contact.way_out(bed, {-0.0295, 0.0, 0.005}), {-0.0005, 0.0, 0.0}, 1e-9);
}

}  // namespace
}  // namespace sandstroke
