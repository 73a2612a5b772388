#include "sim/elastic_wrench.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace sandstroke {
namespace {

using Six = ElasticWrench::Six;

Six along(int axis, double size) { return size * Six::Unit(axis); }

TEST(ElasticWrench, IsALinearSpringBelowWhatTheLawAsksFor) {
  ElasticWrench wrench;
  const double stiffness = 800.0;
  double z = 0.0;
  for (const double way : {-1e-4, -3e-4, 2e-4, -5e-5}) {
    z += way;
    EXPECT_NEAR(wrench.follow(along(2, 5.0), stiffness, along(2, way))[2], -stiffness * z, 1e-12);
    EXPECT_NEAR(wrench.stored(), 0.5 * stiffness * z * z, 1e-15);
  }
}

TEST(ElasticWrench, BecomesWhatTheLawAsksForWhereverThatTakesEnergy) {
  for (const double angle : {0.0, 0.5, 1.0, 1.4}) {
    ElasticWrench wrench;
    Six asked = Six::Zero();
    asked[0] = -std::cos(angle);
    asked[2] = std::sin(angle);
    for (int i = 0; i < 3000; ++i) wrench.follow(asked, 1000.0, along(0, 1e-5));
    EXPECT_LT((wrench.follow(asked, 1000.0, along(0, 1e-5)) - asked).norm(), 1e-6) << angle;
  }
}

TEST(ElasticWrench, StaysWhereTheToolRests) {
  ElasticWrench wrench;
  const Six before = wrench.follow(along(2, 2.0), 1000.0, along(2, -1e-3));
  for (const double asked : {3.0, 0.5, -1.0})
    EXPECT_EQ(wrench.follow(along(2, asked), 1000.0, Six::Zero()), before);
}

TEST(ElasticWrench, IsANumberWhereAWayDoublesTheForce) {
  // Then both balls are one.
  for (double most = 1.5; most < 2.0; most += 1.0 / 512.0) {
    ElasticWrench wrench;
    EXPECT_EQ(wrench.follow(along(2, 1.0), 1000.0, along(2, -1e-3)), along(2, 1.0));
    EXPECT_TRUE(wrench.follow(along(0, most), 1000.0, along(2, -1e-3)).allFinite()) << most;
  }
}

TEST(ElasticWrench, GivesNoMoreThanWentInAndIsNoStifferThanTold) {
  std::mt19937 random(1);
  const auto number = [&] { return static_cast<double>(random()) / 2147483648.0 - 1.0; };
  const auto six = [&](double size) { return Six(size * Six::NullaryExpr([&](auto) { return number(); })); };
  ElasticWrench wrench;
  Six asked = six(3.0), force = Six::Zero();
  double work = 0.0, held = 0.0, most_held = 0.0;
  for (int i = 0; i < 20000; ++i) {
    if (i % 7 == 0) asked = six(3.0);
    const double stiffness = 500.0 * (1.5 + number());
    const Six way = six(2e-4);
    held -= force.dot(way);
    most_held += 0.5 * stiffness * way.squaredNorm();
    const double stored = wrench.stored(), size = force.norm();
    force = wrench.follow(asked, stiffness, way, 2.0);
    work -= force.dot(way);
    EXPECT_LE(wrench.stored() - stored, -force.dot(way) + 1e-12);
    EXPECT_LE(force.norm() - size, stiffness * way.norm() + 1e-12);
    EXPECT_LE(force.head<3>().norm(), 2.0 + 1e-12);
    EXPECT_GE(work, wrench.stored() - 1e-9);
    // With the force held from tick to tick.
    EXPECT_GE(held, wrench.stored() - most_held - 1e-9);
  }
}

}  // namespace
}  // namespace sandstroke
