#include "report/curve.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

namespace sandstroke {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

Curve curve_of(std::size_t points, const std::function<double(std::size_t)>& value) {
  Curve curve;
  for (std::size_t i = 0; i < points; ++i) {
    curve.at.push_back(0.001 * static_cast<double>(i));
    curve.value.push_back(value(i));
  }
  return curve;
}

TEST(ThinnedCurve, LeavesAShortOneAlone) {
  const Curve curve = curve_of(100, [](std::size_t i) { return std::sin(static_cast<double>(i)); });
  const Curve kept = thinned_curve(curve, 100);
  EXPECT_EQ(kept.at, curve.at);
  EXPECT_EQ(kept.value, curve.value);
}

TEST(ThinnedCurve, KeepsTheEndsOfEachStretchOfARamp) {
  // 1000 points in 10 stretches: the least of stretch k is point 100 k, the greatest point 100 k + 99.
  const Curve kept = thinned_curve(curve_of(1000, [](std::size_t i) { return static_cast<double>(i); }), 20);
  ASSERT_EQ(kept.value.size(), 20u);
  for (std::size_t k = 0; k < 10; ++k) {
    EXPECT_EQ(kept.value[2 * k], 100.0 * static_cast<double>(k));
    EXPECT_EQ(kept.value[2 * k + 1], 100.0 * static_cast<double>(k) + 99.0);
    EXPECT_EQ(kept.at[2 * k], 0.001 * static_cast<double>(100 * k));
  }
}

TEST(ThinnedCurve, KeepsASpikeOfOneTickWhereverItIs) {
  for (const double height : {1.0, -1.0}) {
    for (std::size_t spike = 0; spike < 997; ++spike) {
      const Curve kept =
          thinned_curve(curve_of(997,
                                 [&](std::size_t i) {
                                   return i == spike ? height : 1e-3 * std::sin(0.1 * static_cast<double>(i));
                                 }),
                        50);
      EXPECT_LE(kept.value.size(), 50u);
      const auto found = std::find(kept.value.begin(), kept.value.end(), height);
      ASSERT_NE(found, kept.value.end()) << spike;
      EXPECT_EQ(kept.at[static_cast<std::size_t>(found - kept.value.begin())],
                0.001 * static_cast<double>(spike));
      EXPECT_TRUE(std::is_sorted(kept.at.begin(), kept.at.end()));
    }
  }
}

TEST(ThinnedCurve, KeepsGapsAndTheExtremesBesideThem) {
  const Curve kept = thinned_curve(curve_of(1000,
                                            [](std::size_t i) {
                                              if (i == 500) return nan;
                                              if (i == 503) return HUGE_VAL;
                                              return i == 501 ? 7.0 : i == 502 ? -7.0 : 0.0;
                                            }),
                                   20);
  EXPECT_EQ(std::count_if(kept.value.begin(), kept.value.end(), [](double v) { return !std::isfinite(v); }),
            1);
  EXPECT_EQ(std::count(kept.value.begin(), kept.value.end(), 7.0), 1);
  EXPECT_EQ(std::count(kept.value.begin(), kept.value.end(), -7.0), 1);
}

TEST(ThinnedCurve, KeepsGapsWhereThereAreOnlyGaps) {
  const Curve kept = thinned_curve(curve_of(100, [](std::size_t) { return nan; }), 10);
  EXPECT_EQ(kept.value.size(), 5u);
}

}  // namespace
}  // namespace sandstroke
