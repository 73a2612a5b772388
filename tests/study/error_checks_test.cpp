// The errors that runs state of themselves, beside their true ones (bench, quick).
#include "study/error_checks.h"

#include <gtest/gtest.h>

namespace sandstroke {
namespace {

std::vector<ErrorCheck> checks_of(const ProblemMaker& maker) {
  ProblemOptions options;
  options.quick = true;
  const Problem problem = maker.make(options);
  return problem.check_errors ? problem.check_errors() : std::vector<ErrorCheck>{};
}

TEST(ErrorChecks, TellEveryErrorWithinAFactorOfThree) {
  int checks = 0;
  for (const ProblemMaker& maker : problem_makers()) {
    // Straight edges along the grid: at some cell sizes their error all but vanishes, at twice those not.
    const bool edges_on_borders = maker.name == std::string("cliff") || maker.name == std::string("trench");
    for (const ErrorCheck& check : checks_of(maker)) {
      if (edges_on_borders && check.label.find("coarser") != std::string::npos) continue;
      SCOPED_TRACE(std::string(maker.name) + ", " + check.label + ": " + check.quantity);
      EXPECT_GT(check.estimate, check.truth / 3.0);
      EXPECT_LT(check.estimate, check.truth * 3.0);
      ++checks;
    }
  }
  EXPECT_GE(checks, 20);
}

}  // namespace
}  // namespace sandstroke
