#include "sweep/sweep_design.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace sandstroke {
namespace {

TEST(SpreadIndices, AreAllOrSomeWithBothEnds) {
  EXPECT_EQ(spread_indices(3, 5), (std::vector<std::size_t>{0, 1, 2}));
  EXPECT_EQ(spread_indices(5, 5), (std::vector<std::size_t>{0, 1, 2, 3, 4}));
  EXPECT_EQ(spread_indices(100, 4), (std::vector<std::size_t>{0, 33, 66, 99}));
  EXPECT_EQ(spread_indices(10'000'000, 2), (std::vector<std::size_t>{0, 9'999'999}));
}

SweepAxis axis(const std::string& key, std::vector<std::string> values) {
  return {key, "", false, std::move(values)};
}

TEST(SweepDesign, AGridHasEveryCombinationOnceTheLastAxisFastest) {
  const SweepDesign design{true, {axis("a", {"1", "2"}), axis("b", {"x", "y", "z"}), axis("c", {"5"})}};
  EXPECT_EQ(design.shape(), (std::vector<std::size_t>{2, 3, 1}));
  ASSERT_EQ(design.points(), 6u);
  std::set<std::vector<std::string>> seen;
  for (std::size_t point = 0; point < design.points(); ++point) {
    seen.insert(design.settings(point));
    // The index in an array of that shape, as C orders it.
    EXPECT_EQ((design.value_at(point, 0) * 3 + design.value_at(point, 1)) * 1 + design.value_at(point, 2),
              point);
  }
  EXPECT_EQ(seen.size(), 6u);
  EXPECT_EQ(design.settings(5), (std::vector<std::string>{"a=2", "b=z", "c=5"}));
}

TEST(SweepDesign, ALatinPointTakesTheValueOfItsIndex) {
  const SweepDesign design{false, {axis("a", {"3", "1", "2"}), axis("b", {"x", "z", "y"})}};
  EXPECT_EQ(design.shape(), std::vector<std::size_t>{3});
  EXPECT_EQ(design.settings(1), (std::vector<std::string>{"a=1", "b=z"}));
}

TEST(SweepDesign, TellsNumbersFromText) {
  EXPECT_TRUE(axis("a", {"1", "2.5", "-3e5"}).numeric());
  EXPECT_FALSE(axis("a", {"1", "\"x\""}).numeric());
  EXPECT_FALSE(axis("a", {"[1, 2]"}).numeric());
  EXPECT_EQ(axis("a", {"2.5"}).number(0), 2.5);
  EXPECT_EQ(axis("a", {"\"paper\""}).label(0), "paper");
}

TEST(Spread, EndsAreExactAndStepsAreTheDecimalsOneMeans) {
  EXPECT_EQ(spread(20.0, 45.0, 11, false)[3], 27.5);
  EXPECT_EQ(spread(0.1, 0.5, 5, false), (std::vector<double>{0.1, 0.2, 0.3, 0.4, 0.5}));
  EXPECT_EQ(spread(-0.1, 0.5, 7, false), (std::vector<double>{-0.1, 0.0, 0.1, 0.2, 0.3, 0.4, 0.5}));
  EXPECT_EQ(spread(1.0, 10000.0, 5, true), (std::vector<double>{1.0, 10.0, 100.0, 1000.0, 10000.0}));
  EXPECT_EQ(spread(1.0 / 3.0, 1e-17, 2, true), (std::vector<double>{1.0 / 3.0, 1e-17}));
  EXPECT_EQ(spread(7.0, 9.0, 1, false), std::vector<double>{7.0});
  EXPECT_EQ(spread(1e-310, 4e-310, 3, false)[1], 2.5e-310);  // below what std::stod takes
}

TEST(LatinHypercube, EachAxisHasOneNumberInEachNth) {
  constexpr std::size_t n = 97;
  const auto samples = latin_hypercube(3, n, 5);
  for (const std::vector<double>& axis : samples) {
    std::set<int> strata;
    for (const double x : axis) {
      EXPECT_GE(x, 0.0);
      EXPECT_LT(x, 1.0);
      strata.insert(static_cast<int>(std::floor(x * n)));
    }
    EXPECT_EQ(strata.size(), n);
    EXPECT_FALSE(std::is_sorted(axis.begin(), axis.end()));
  }
  EXPECT_NE(samples[0], samples[1]);
}

TEST(LatinHypercube, NoAxisGoesWithAnotherOrWithTheOrderOfPoints) {
  constexpr std::size_t n = 400;
  auto axes = latin_hypercube(3, n, 5);
  axes.emplace_back(n);
  for (std::size_t i = 0; i < n; ++i) axes.back()[i] = static_cast<double>(i) / n;
  for (std::size_t a = 0; a < axes.size(); ++a)
    for (std::size_t b = 0; b < a; ++b) {
      double sum = 0.0;
      for (std::size_t i = 0; i < n; ++i) sum += (axes[a][i] - 0.5) * (axes[b][i] - 0.5);
      EXPECT_LT(std::abs(12.0 * sum / n), 4.0 / std::sqrt(n)) << a << ' ' << b;  // 4 standard deviations
    }
}

TEST(LatinHypercube, FollowsFromItsSeed) {
  EXPECT_EQ(latin_hypercube(2, 10, 1), latin_hypercube(2, 10, 1));
  EXPECT_NE(latin_hypercube(2, 10, 1), latin_hypercube(2, 10, 2));
}

}  // namespace
}  // namespace sandstroke
