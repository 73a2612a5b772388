// The errors that runs state of themselves, beside their true ones (bench, quick).
#include "validation/study/error_checks.h"
#include "sanitized.h"

#include <gtest/gtest.h>

namespace sandstroke {
namespace {

std::vector<ErrorCheck> checks_of(const ProblemMaker& maker) {
  ProblemOptions options;
  options.quick = true;
  const Problem problem = maker.make(options);
  return problem.check_errors ? problem.check_errors() : std::vector<ErrorCheck>{};
}

TEST(ErrorChecks, AFinerSolutionTellsEveryErrorWithinAFactorOfThree) {
  if (sanitized) GTEST_SKIP() << "long; what it runs through, shorter tests do";
  int checks = 0;
  for (const ProblemMaker& maker : problem_makers())
    for (const ErrorCheck& check : checks_of(maker)) {
      if (check.label.find("finer") == std::string::npos) continue;
      SCOPED_TRACE(std::string(maker.name) + ", " + check.label + ": " + check.quantity);
      EXPECT_GT(check.estimate, check.truth / 3.0);
      EXPECT_LT(check.estimate, check.truth * 3.0);
      ++checks;
    }
  EXPECT_GE(checks, 10);
}

}  // namespace
}  // namespace sandstroke
