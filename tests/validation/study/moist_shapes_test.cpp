// Problems of moist sand: their answers come to the closed forms with first order.
#include <gtest/gtest.h>

#include <cmath>

#include "validation/study/errors_of.h"

namespace sandstroke {
namespace {

TEST(MoistProblems, CutsStandHigherThanTheyMayByHalfACellOrLess) {
  const auto errors = errors_of("cut");
  ASSERT_EQ(errors.size(), 6u);
  for (const auto& [series, of_series] : errors) {
    ASSERT_EQ(of_series.size(), 3u) << series;
    for (int i = 0; i < 3; ++i) EXPECT_LE(of_series[i], 0.55 / (10 << i)) << series;
  }
}

TEST(MoistProblems, AFailedWallComesNearerWithFirstOrder) {
  for (const auto& [series, errors] : errors_of("wall")) {
    ASSERT_EQ(errors.size(), 3u) << series;
    for (int i = 0; i < 3; ++i)
      EXPECT_LE(errors[i], 2.0 / (48 << i)) << series;  // of the moved sand, by cells
  }
}

}  // namespace
}  // namespace sandstroke
