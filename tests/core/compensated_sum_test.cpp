#include "core/compensated_sum.h"

#include <gtest/gtest.h>

namespace sandstroke {
namespace {

TEST(CompensatedSum, KeepsWhatPlainAdditionLoses) {
  CompensatedSum sum;
  sum.add(1.0);
  sum.add(1e100);
  sum.add(1.0);
  sum.add(-1e100);
  EXPECT_EQ(sum.value(), 2.0);  // Neumaier's own example; plain addition gives 0
}

TEST(CompensatedSum, ErrorDoesNotGrowWithTheNumberOfTerms) {
  CompensatedSum sum;
  for (int i = 0; i < 10'000'000; ++i) sum.add(0.1);
  EXPECT_NEAR(sum.value(), 1e6 + 1e7 * (0.1 - 1.0 / 10.0), 1e-9);
}

}  // namespace
}  // namespace sandstroke
