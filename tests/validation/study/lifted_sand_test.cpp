// Sand on a lifted disc comes to the closed form with first order, level or tilted.
#include <gtest/gtest.h>

#include "validation/study/errors_of.h"

namespace sandstroke {
namespace {

TEST(LiftProblem, ComesNearerToItsClosedFormHoweverTheDiscIsTilted) {
  const auto errors = errors_of("lift");
  ASSERT_EQ(errors.size(), 5u);
  for (const auto& [series, of_series] : errors) {
    ASSERT_GE(of_series.size(), 2u) << series;
    // First order would be 0.71 of the error with 1.4 times the cells.
    for (std::size_t i = 1; i < of_series.size(); ++i)
      EXPECT_LT(of_series[i], 0.85 * of_series[i - 1]) << series;
    EXPECT_LT(of_series[1], 0.14) << series;
  }
  const std::vector<double>& level = errors.at("level");
  EXPECT_NEAR(level.back() / level.front(), 0.5, 0.1);  // 10 and 20 cells per radius
}

}  // namespace
}  // namespace sandstroke
