#include "validation/study/problem.h"

#include <gtest/gtest.h>

#include <set>

#include "validation/study/study_table.h"

namespace sandstroke {
namespace {

TEST(Problems, HaveNamesOfTheirOwnAndCurvesThatCanBeRead) {
  std::set<std::string> names;
  ProblemOptions quick;
  quick.quick = true;
  for (const ProblemMaker& maker : problem_makers()) {
    EXPECT_TRUE(names.insert(maker.name).second) << maker.name;
    const Problem problem = maker.make(quick);
    EXPECT_EQ(problem.name, maker.name);
    EXPECT_NO_THROW(number_in(problem.error, StudyRun{}));
    std::set<std::pair<std::string, std::string>> points;
    for (const Contender& one : problem.contenders)
      EXPECT_TRUE(points.emplace(one.series, one.label).second) << one.series << ", " << one.label;
  }
}

}  // namespace
}  // namespace sandstroke
