#include "sweep/effects.h"

#include <gtest/gtest.h>

#include <cmath>

#include "test_folder.h"

namespace sandstroke {
namespace {

SweepAxis axis_of(const std::string& key, std::size_t count) {
  SweepAxis axis{key, "", false, {}};
  for (std::size_t i = 0; i < count; ++i) axis.values.push_back(std::to_string(i));
  return axis;
}

/// A sweep with one metric, whose value at a point is value(indices of its axes' values).
template <class Value>
CollectedSweep swept(const SweepFolder& folder, const Value& value) {
  const SweepDesign& design = folder.design();
  for (std::size_t point = 0; point < design.points(); ++point) {
    std::vector<double> at;
    for (std::size_t axis = 0; axis < design.axes.size(); ++axis)
      at.push_back(design.axes[axis].number(design.value_at(point, axis)));
    folder.write(point, {PointVerdict::at_rest, "", {value(at)}}, "", {});
  }
  CollectReport report;
  return {folder, report};
}

class Effects : public testing::Test {
 protected:
  SweepFolder folder_of(SweepDesign design) const {
    SweepManifest manifest;
    manifest.scene = "scene.toml";
    manifest.design = std::move(design);
    manifest.metrics = {"max_force"};
    return SweepFolder::make(path_ / "sweep", manifest);
  }
  const TestFolder path_;
};

using Axes = std::vector<std::size_t>;

// a + 2 b + 3 a b over a, b in {0, 1}, c idle: of the variance (by orthogonal contrasts, each squared and
// halved) a has (1 + 1.5)^2, b (2 + 1.5)^2, both together 1.5^2.
TEST_F(Effects, OfAFullGridAreTheSharesOfItsContrasts) {
  const SweepFolder folder = folder_of({true, {axis_of("a", 2), axis_of("b", 2), axis_of("c", 3)}});
  const CollectedSweep sweep =
      swept(folder, [](const std::vector<double>& at) { return at[0] + 2.0 * at[1] + 3.0 * at[0] * at[1]; });
  const std::vector<Effect> effects = effects_on(sweep, 0);
  const double all = 2.5 * 2.5 + 3.5 * 3.5 + 1.5 * 1.5;
  ASSERT_EQ(effects.size(), 6u);
  EXPECT_EQ(effects[0].axes, (Axes{1}));
  EXPECT_NEAR(effects[0].share, 3.5 * 3.5 / all, 1e-12);
  EXPECT_NEAR(effects[0].greatest - effects[0].least, 3.5, 1e-12);
  EXPECT_EQ(effects[1].axes, (Axes{0}));
  EXPECT_NEAR(effects[1].share, 2.5 * 2.5 / all, 1e-12);
  EXPECT_EQ(effects[2].axes, (Axes{0, 1}));
  EXPECT_NEAR(effects[2].share, 1.5 * 1.5 / all, 1e-12);
  for (std::size_t i = 3; i < 6; ++i) EXPECT_NEAR(effects[i].share, 0.0, 1e-12);
  EXPECT_EQ(idle_axes(sweep), (Axes{2}));
}

TEST_F(Effects, AMetricThatIsTheSameEverywhereHasNone) {
  const SweepFolder folder = folder_of({true, {axis_of("a", 3)}});
  const CollectedSweep sweep = swept(folder, [](const std::vector<double>&) { return 7.0; });
  EXPECT_TRUE(effects_on(sweep, 0).empty());
  EXPECT_EQ(idle_axes(sweep), (Axes{0}));
}

TEST_F(Effects, PointsWithoutAValueAreLeftOut) {
  const SweepFolder folder = folder_of({true, {axis_of("a", 3), axis_of("b", 2)}});
  const CollectedSweep sweep =
      swept(folder, [](const std::vector<double>& at) { return at[0] == 2.0 ? std::nan("") : at[0]; });
  const std::vector<Effect> effects = effects_on(sweep, 0);
  EXPECT_EQ(effects[0].axes, (Axes{0}));
  EXPECT_NEAR(effects[0].share, 1.0, 1e-12);
  EXPECT_EQ(idle_axes(sweep), (Axes{1}));
}

// y = a; at a = b = 1 the point fails. The means of b would hold a part of a's effect, and b lets a point
// fail.
TEST_F(Effects, AnAxisThatLetsPointsFailIsNotIdle) {
  const SweepFolder folder = folder_of({true, {axis_of("a", 2), axis_of("b", 2)}});
  const CollectedSweep sweep = swept(folder, [](const std::vector<double>& at) {
    return at[0] == 1.0 && at[1] == 1.0 ? std::nan("") : at[0];
  });
  EXPECT_TRUE(idle_axes(sweep).empty());
}

// A list of two numbers in a hypercube of 27 points, which are 3 groups of 9.
TEST_F(Effects, EqualNumbersOfAHypercubeAreOneGroup) {
  SweepDesign design{false, {axis_of("a", 27), axis_of("b", 27)}};
  for (std::size_t i = 0; i < 27; ++i) design.axes[1].values[i] = i * 7 % 27 < 13 ? "500" : "1000";
  const SweepFolder folder = folder_of(std::move(design));
  const CollectedSweep sweep = swept(folder, [](const std::vector<double>& at) { return at[1]; });
  const std::vector<Effect> effects = effects_on(sweep, 0);
  EXPECT_EQ(effects[0].axes, (Axes{1}));
  EXPECT_NEAR(effects[0].share, 1.0, 1e-12);
}

// y = x0 of 500 points: x1, which chance orders, has next to no share.
TEST_F(Effects, OfALatinHypercubeAreByNeighbouringValues) {
  SweepDesign design{false, {axis_of("a", 500), axis_of("b", 500)}};
  for (std::size_t i = 0; i < 500; ++i) design.axes[1].values[i] = std::to_string(i * 211 % 500);
  const SweepFolder folder = folder_of(std::move(design));
  const CollectedSweep sweep = swept(folder, [](const std::vector<double>& at) { return at[0]; });
  const std::vector<Effect> effects = effects_on(sweep, 0);
  ASSERT_EQ(effects.size(), 2u);
  EXPECT_EQ(effects[0].axes, (Axes{0}));
  EXPECT_GT(effects[0].share, 0.97);  // 8 groups hold all but 1/64 of a straight line's variance
  EXPECT_LT(effects[1].share, 0.03);
  EXPECT_TRUE(idle_axes(sweep).empty());
}

}  // namespace
}  // namespace sandstroke
