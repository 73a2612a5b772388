#include <gtest/gtest.h>

#include "stress/stress.h"
#include "stress/surprises.h"

namespace sandstroke {
namespace {

TEST(StressRelaxation, TheQuickSetHasNoSurprise) {
  StressReport report;
  StressOptions options;
  options.quick = true;
  double done = 0.0;
  options.progress = [&done](double share) {
    EXPECT_GE(share, done);
    done = share;
  };
  stress_relaxation(report, options);
  expect_no_surprises(report);
  EXPECT_NEAR(done, 1.0, 1e-9);
}

}  // namespace
}  // namespace sandstroke
