#pragma once

#include <gtest/gtest.h>

#include "stress/stress_report.h"

namespace sandstroke {

/// No case or map of a part ended as nobody expected.
inline void expect_no_surprises(const StressReport& report) {
  EXPECT_GT(report.cases.size(), 0u);
  for (const StressCase& one : report.cases)
    EXPECT_FALSE(one.surprise()) << one.group << ", " << one.name << " (" << one.settings
                                 << "): " << name_of(one.verdict) << "; " << one.detail;
  EXPECT_EQ(report.surprises(), 0);
}

}  // namespace sandstroke
