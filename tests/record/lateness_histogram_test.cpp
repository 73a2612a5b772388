#include "record/lateness_histogram.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

namespace sandstroke {
namespace {

TEST(LatenessHistogram, IsAllZeroBeforeTheFirstTick) {
  const Lateness none = LatenessHistogram().summary();
  EXPECT_EQ(none.mean, 0.0);
  EXPECT_EQ(none.p99, 0.0);
  EXPECT_EQ(none.max, 0.0);
}

TEST(LatenessHistogram, OneTickIsMeanPercentileAndMaximum) {
  for (const std::int64_t late : {0, 1, 999, 1000, 5'000'123, 9'999'999, 10'000'000, 2'000'000'000}) {
    LatenessHistogram histogram;
    histogram.add(late);
    EXPECT_EQ(histogram.max(), late);
    EXPECT_DOUBLE_EQ(histogram.summary().mean, 1e-9 * static_cast<double>(late));
    EXPECT_DOUBLE_EQ(histogram.summary().p99, 1e-9 * static_cast<double>(late));
    EXPECT_DOUBLE_EQ(histogram.summary().max, 1e-9 * static_cast<double>(late));
  }
}

TEST(LatenessHistogram, CountsWhatIsEarlyAsOnTime) {
  LatenessHistogram histogram;
  histogram.add(-5);
  EXPECT_EQ(histogram.summary().mean, 0.0);
  EXPECT_EQ(histogram.summary().max, 0.0);
}

TEST(LatenessHistogram, AgreesWithTheSortedListToItsResolution) {
  std::mt19937_64 random(7);
  for (const int count : {2, 99, 100, 101, 250, 12'345}) {
    LatenessHistogram histogram;
    std::vector<std::int64_t> all;
    for (int i = 0; i < count; ++i) {
      all.push_back(std::uniform_int_distribution<std::int64_t>(0, 9'000'000)(random));
      histogram.add(all.back());
    }
    std::sort(all.begin(), all.end());
    const auto rank = static_cast<std::size_t>((99 * count + 99) / 100);  // ceil(0.99 n), from 1
    const double p99 = 1e-9 * static_cast<double>(all[rank - 1]);
    const Lateness summary = histogram.summary();
    EXPECT_GE(summary.p99, p99 * (1.0 - 1e-15)) << count;
    EXPECT_LE(summary.p99, p99 + 1.000001e-6) << count;
    EXPECT_LE(summary.p99, summary.max);
    EXPECT_DOUBLE_EQ(summary.max, 1e-9 * static_cast<double>(all.back()));
    EXPECT_DOUBLE_EQ(summary.mean,
                     1e-9 * static_cast<double>(std::accumulate(all.begin(), all.end(), 0LL)) / count);
  }
}

TEST(LatenessHistogram, OneHangAmongManyTicksIsTheMaximumOnly) {
  LatenessHistogram histogram;
  for (int i = 0; i < 999; ++i) histogram.add(2'500);
  histogram.add(3'000'000'000);
  EXPECT_DOUBLE_EQ(histogram.summary().p99, 3e-6);
  EXPECT_DOUBLE_EQ(histogram.summary().max, 3.0);
}

}  // namespace
}  // namespace sandstroke
