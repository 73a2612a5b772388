// The error of a collapse falls with the cell size; its flanks are right in every direction.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "sanitized.h"
#include "validation/study/study.h"

namespace sandstroke {
namespace {

/// The scores of one series of a problem, as `sandstroke bench` runs it, up to so many cells.
std::vector<std::pair<Contender, Score>> run_series(const Problem& problem, const std::string& series,
                                                    int most_cells) {
  std::vector<std::pair<Contender, Score>> scores;
  for (const Contender& one : problem.contenders)
    if (one.series == series && one.settings.cells <= most_cells) scores.emplace_back(one, one.run().score);
  return scores;
}

class Collapse : public testing::TestWithParam<Problem (*)(const ProblemOptions&)> {};
INSTANTIATE_TEST_SUITE_P(OfA, Collapse, testing::Values(cylinder_problem, cone_problem),
                         [](const auto& problem) { return problem.param({}).name; });

TEST_P(Collapse, IsOfFirstOrderWithRightFlanksAllAroundByTheIsotropicLaw) {
  if (sanitized) GTEST_SKIP() << "long; what it runs through, shorter tests do";
  std::vector<std::pair<double, double>> errors;
  for (const auto& [contender, score] : run_series(GetParam()({}), "isotropic rkl", 1024)) {
    EXPECT_TRUE(score.converged);
    EXPECT_LT(score.volume_drift, 1e-12);
    errors.emplace_back(contender.step, score.l1);
    if (contender.settings.cells == 512.0) {
      EXPECT_LT(score.slope_error, 0.15);  // deg
    }
  }
  ASSERT_EQ(errors.size(), 5u);  // 64 to 1024 cells along a side
  const ConvergenceOrder fit = fit_order(errors);
  std::printf("order %.3f, %.3f to %.3f\n", fit.order, fit.low, fit.high);
  EXPECT_GE(fit.order, 1.0);
}

TEST_P(Collapse, StaysThatFarFromTheConeByThePapersLawWhateverTheCells) {
  const auto scores = run_series(GetParam()({}), "paper passes", 256);
  ASSERT_EQ(scores.size(), 3u);
  EXPECT_GT(scores.back().second.l1, 0.8 * scores.front().second.l1);
  EXPECT_GT(scores.back().second.slope_error, 0.8);  // deg
}

TEST(DrainedCrater, ShowsThePapersTwoDegreesAtAnyCellSizeAndTheIsotropicLawNone) {
  const Problem problem = crater_problem({});
  for (const auto& [contender, score] : run_series(problem, "paper passes", 128)) {
    EXPECT_LT(score.l1, 2e-3);  // of the octagon: what the tolerance leaves
    EXPECT_NEAR(score.slope_error, 2.0, 0.2) << contender.label;
  }
  double last = 2.0;
  for (const auto& [contender, score] : run_series(problem, "isotropic rkl", 128)) {
    EXPECT_LT(score.slope_error, last) << contender.label;
    last = score.slope_error;
  }
}

}  // namespace
}  // namespace sandstroke
