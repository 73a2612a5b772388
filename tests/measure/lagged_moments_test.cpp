#include "measure/lagged_moments.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace sandstroke {
namespace {

/// Forces of chance around an offset, on ticks of 1 ms; some are left out, some have no recorded force.
std::vector<ForcePair> chance(int count) {
  std::mt19937 random(7);
  const auto force = [&] {
    const auto part = [&] { return 1e-9 * static_cast<double>(random()) + 3.0; };
    return Eigen::Vector3d(part(), part(), part());
  };
  std::vector<ForcePair> ticks;
  for (int k = 0; k < count; ++k) {
    if (k > count / 3 && k < count / 2) continue;
    ticks.push_back({1e-3 * k, force(), force()});
    if (random() % 5 == 0) ticks.back().recorded.setConstant(std::numeric_limits<double>::quiet_NaN());
  }
  return ticks;
}

TEST(LaggedMoments, AreThoseOfEachLag) {
  for (const int count : {2, 50, 3000}) {
    const std::vector<ForcePair> ticks = chance(count);
    const std::ptrdiff_t most = std::min(count, 80);
    const std::vector<Moments> all = lagged_moments(ticks, 1e-3, most);
    ASSERT_EQ(all.size(), static_cast<std::size_t>(2 * most + 1));
    for (std::ptrdiff_t lag = -most; lag <= most; ++lag) {
      const Moments& found = all[static_cast<std::size_t>(lag + most)];
      const Moments exact = moments_at(ticks, 1e-3, lag);
      EXPECT_EQ(found.ticks, exact.ticks) << lag;
      const double rounding = 1e-11 * (exact.aa + exact.bb) + 1e-9;
      EXPECT_NEAR(found.aa, exact.aa, rounding) << lag;
      EXPECT_NEAR(found.bb, exact.bb, rounding) << lag;
      EXPECT_NEAR(found.ab, exact.ab, rounding) << lag;
      EXPECT_LT((found.a - exact.a).norm(), rounding) << lag;
      EXPECT_LT((found.b - exact.b).norm(), rounding) << lag;
    }
  }
}

TEST(LaggedMoments, PairTheRunLaterWithTheRecordingNow) {
  std::vector<ForcePair> ticks(10, ForcePair{0.0, Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()});
  for (int k = 0; k < 10; ++k) ticks[static_cast<std::size_t>(k)].time = 0.5 * k;
  ticks[3].recorded.x() = 2.0;
  ticks[5].run.x() = 3.0;
  EXPECT_EQ(moments_at(ticks, 0.5, 2).ab, 6.0);
  EXPECT_EQ(moments_at(ticks, 0.5, 1).ab, 0.0);
  EXPECT_EQ(moments_at(ticks, 0.5, -2).ab, 0.0);
  EXPECT_EQ(moments_at(ticks, 0.5, 2).ticks, 8.0);
}

}  // namespace
}  // namespace sandstroke
