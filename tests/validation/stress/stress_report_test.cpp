#include "validation/stress/stress_report.h"

#include <gtest/gtest.h>

namespace sandstroke {
namespace {

TEST(StressReport, AVerdictThatNobodyExpectedIsASurprise) {
  StressCase one{"group", "name", "", {Verdict::stable, Verdict::limit_cycle}, Verdict::stable, ""};
  EXPECT_FALSE(one.surprise());
  one.verdict = Verdict::diverged;
  EXPECT_TRUE(one.surprise());
  one.expected = {};
  EXPECT_TRUE(one.surprise());
}

TEST(StressReport, CountsSurprisesInCasesAndMaps) {
  StressReport report;
  report.cases.push_back({"g", "n", "", {Verdict::stable}, Verdict::broken, ""});
  report.cases.push_back({"g", "n", "", {Verdict::refused}, Verdict::refused, ""});
  StabilityMap map;
  map.surprise = {{false, true}, {true, false}};
  report.maps.push_back(map);
  EXPECT_EQ(report.surprises(), 3);
  EXPECT_EQ(as_json(report)["surprises"], 3);
}

}  // namespace
}  // namespace sandstroke
