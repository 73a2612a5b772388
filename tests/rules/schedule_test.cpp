#include "rules/schedule.h"

#include <gtest/gtest.h>

namespace sandstroke {
namespace {

TEST(RelaxationByWay, AsksAsTheToolTouchesDownHasGoneItsWayAndLeaves) {
  RelaxationByWay schedule(true);
  const Eigen::Vector3d here(0.1, 0.2, -0.003);
  EXPECT_FALSE(schedule.is_due(here, false));
  EXPECT_TRUE(schedule.is_due(here, true));
  schedule.relaxed(here, true, 0.01);
  EXPECT_FALSE(schedule.is_due(here, true));
  EXPECT_FALSE(schedule.is_due(here + Eigen::Vector3d(0.0, 0.0099, 0.0), true));
  EXPECT_FALSE(schedule.is_due(here + Eigen::Vector3d(0.006, -0.006, 0.009), true));  // 8.5 mm along the bed
  EXPECT_TRUE(schedule.is_due(here + Eigen::Vector3d(0.008, -0.008, 0.0), true));
  EXPECT_TRUE(schedule.is_due(here + Eigen::Vector3d(0.0, 0.0, -0.01), true));
  EXPECT_TRUE(schedule.is_due(here, false));
  schedule.relaxed(here, false, 0.0);
  EXPECT_FALSE(schedule.is_due(here, false));
}

TEST(RelaxationByWay, EachWayIsItsOwn) {
  RelaxationByWay schedule(true);
  schedule.relaxed({0.0, 0.0, 0.0}, true, 0.01);
  schedule.relaxed({0.01, 0.0, 0.0}, true, 0.002);
  EXPECT_TRUE(schedule.is_due({0.012, 0.0, 0.0}, true));
  EXPECT_FALSE(schedule.is_due({0.0119, 0.0, 0.0}, true));
  EXPECT_NEAR(schedule.way_to_next({0.01, 0.0, 0.0}, {0.004, 0.0, 0.0}).value(), 0.5, 1e-12);
}

TEST(RelaxationByWay, NeverAsksWhereItIsOff) {
  const RelaxationByWay schedule(false);
  EXPECT_FALSE(schedule.is_due({1.0, 2.0, 3.0}, true));
  EXPECT_FALSE(schedule.way_to_next({0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}));
}

TEST(RelaxationByWay, FindsWhereOnAStepTheNextRelaxationIsDue) {
  RelaxationByWay schedule(true);
  EXPECT_FALSE(schedule.way_to_next({0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}));  // nothing has relaxed
  schedule.relaxed({0.0, 0.0, 0.0}, true, 0.01);
  EXPECT_NEAR(schedule.way_to_next({0.004, 0.0, 0.0}, {0.008, 0.0, -0.5}).value(), 0.75, 1e-12);
  EXPECT_FALSE(schedule.way_to_next({0.004, 0.0, 0.0}, {0.0059, 0.0, 0.0}));
  EXPECT_FALSE(schedule.way_to_next({0.004, 0.0, 0.0}, {0.0, 0.0, -1.0}));  // straight down
  // Back through where it relaxed, and out on the other side.
  EXPECT_NEAR(schedule.way_to_next({0.005, 0.0, 0.0}, {-0.02, 0.0, 0.0}).value(), 0.75, 1e-12);
  // A step from 10 mm behind the position where sand relaxed, to 10 mm ahead of it.
  EXPECT_NEAR(schedule.way_to_next({-0.0099999, 0.0, 0.0}, {0.04, 0.0, 0.0}).value(), 0.5, 1e-4);
}

}  // namespace
}  // namespace sandstroke
