// Problems of sand on stones and of two kinds: their answers come to the closed forms at the orders that
// theory and prototypes give.
#include <gtest/gtest.h>

#include <cmath>

#include "validation/study/errors_of.h"

namespace sandstroke {
namespace {

/// The mean order between the coarsest of a series and its finest, whose cells are `times` smaller.
double mean_order(const std::vector<double>& errors, double times) {
  return std::log(errors.front() / errors.back()) / std::log(times);
}

TEST(GroundProblems, ASlopeOverASeamComesNearerWithAnOrderAboveOneAndAHalf) {
  const auto errors = errors_of("seam");
  for (const char* series : {"paper passes", "isotropic passes", "faces passes"}) {
    ASSERT_EQ(errors.at(series).size(), 3u);
    EXPECT_GT(mean_order(errors.at(series), 4.0), 1.5) << series;
    EXPECT_LT(errors.at(series).back(), 1e-3) << series;
  }
  for (const char* series : {"isotropic rkl", "faces rkl"})  // super-steps come to nearly the same rest
    for (const double error : errors.at(series)) EXPECT_LT(error, 3e-3) << series;
}

TEST(GroundProblems, FlanksOverATurnedSeamComeNearerWithFirstOrder) {
  const auto errors = errors_of("ridge");
  EXPECT_GT(mean_order(errors.at("isotropic passes"), 2.0), 0.8);
  for (const auto& [series, of_series] : errors) {
    ASSERT_EQ(of_series.size(), 3u);
    EXPECT_LT(of_series.back(), of_series.front()) << series;
    EXPECT_LT(of_series.back(), 0.2 * 200.0 / 96.0) << series;  // deg: 0.2 with 200 cells
  }
}

TEST(GroundProblems, SandOnADiscComesNearerToItsConeWithFirstOrder) {
  for (const auto& [series, errors] : errors_of("disc")) {
    ASSERT_EQ(errors.size(), 3u);
    EXPECT_GT(mean_order(errors, 2.0), 0.8) << series;
    EXPECT_LT(errors.back(), 0.1) << series;  // the tip is blunt by a few cells
  }
}

TEST(GroundProblems, SandOnASphereComesNearerToItsCap) {
  const auto errors = errors_of("cap");
  EXPECT_NEAR(mean_order(errors.at("isotropic passes"), 2.0), 1.0, 0.2);
  for (const auto& [series, of_series] : errors) {
    ASSERT_EQ(of_series.size(), 3u);
    EXPECT_LT(of_series.back(), of_series.front()) << series;
    EXPECT_LT(of_series.back(), 0.12) << series;
  }
}

}  // namespace
}  // namespace sandstroke
