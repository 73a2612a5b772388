#include "validation/study/advice.h"

#include <gtest/gtest.h>

namespace sandstroke {
namespace {

Problem problem_of(const char* name, const char* subject, double converged_to = not_applicable) {
  Problem problem{name, std::string("The ") + name, "", "l1", "", "", subject};
  problem.converged_to = converged_to;
  return problem;
}

StudyRun run_of(const char* problem, const char* label, double error, double seconds) {
  StudyRun run;
  run.problem = problem;
  run.series = "s";
  run.label = label;
  run.error = error;
  run.wall_seconds = seconds;
  return run;
}

TEST(Advice, ASettingCountsByItsWorstProblemAndOnlyIfItRanInAll) {
  Study study;
  study.problems = {problem_of("cone", "Heaps"), problem_of("cylinder", "Heaps"), problem_of("drag", "")};
  study.runs = {run_of("cone", "64", 0.02, 1.0),       run_of("cone", "128", 0.01, 4.0),
                run_of("cone", "256", 0.001, 9.0),     run_of("cylinder", "64", 0.03, 0.5),
                run_of("cylinder", "128", 0.005, 6.0), run_of("drag", "64", 1e-9, 1e-9)};
  study.runs[3].disturbed = true;
  const std::vector<Advice> advice = advise(study);
  ASSERT_EQ(advice.size(), 1u);
  const Advice& heaps = advice[0];
  EXPECT_EQ(heaps.problems, (std::vector<std::string>{"The cone", "The cylinder"}));
  ASSERT_EQ(heaps.settings.size(), 2u) << "256 cells did not run in both";
  EXPECT_EQ(heaps.settings[0].label, "64");
  EXPECT_EQ(heaps.settings[0].error, 0.03);
  EXPECT_EQ(heaps.settings[0].seconds, 1.0);
  EXPECT_TRUE(heaps.settings[0].disturbed);
  EXPECT_EQ(heaps.settings[1].error, 0.01);
  EXPECT_EQ(heaps.settings[1].seconds, 6.0);
  EXPECT_FALSE(heaps.settings[1].disturbed);
  EXPECT_EQ(heaps.within(0.05), &heaps.settings[0]);
  EXPECT_EQ(heaps.within(0.02), &heaps.settings[1]);
  EXPECT_EQ(heaps.within(0.009), nullptr);
  EXPECT_EQ(&heaps.most_exact(), &heaps.settings[1]);
}

TEST(Advice, TheFrontIsWhatNothingBeatsInBoth) {
  Study study;
  study.problems = {problem_of("stroke", "Strokes")};
  study.runs = {run_of("stroke", "slow", 0.1, 3.0), run_of("stroke", "fast", 0.2, 1.0),
                run_of("stroke", "worse", 0.3, 2.0), run_of("stroke", "exact", 0.05, 5.0)};
  std::vector<std::string> front;
  const auto advised = advise(study);
  for (const AdvisedSetting& one : advised[0].settings)
    if (one.front) front.push_back(one.label);
  EXPECT_EQ(front, (std::vector<std::string>{"fast", "slow", "exact"}));
}

TEST(Advice, NoSettingIsMoreExactThanItsReferenceAndRulesFromOutsideAreNoAdvice) {
  Study study;
  study.problems = {problem_of("stroke", "Strokes", 0.01)};
  study.runs = {run_of("stroke", "lucky", 1e-6, 1.0), run_of("stroke", "plugin", 0.02, 0.1)};
  study.runs[1].external = true;
  const Advice strokes = advise(study).at(0);
  ASSERT_EQ(strokes.settings.size(), 1u);
  EXPECT_EQ(strokes.settings[0].error, 0.01);
  study.runs.erase(study.runs.begin());
  EXPECT_TRUE(advise(study).empty()) << "nothing but a plugin ran";
}

}  // namespace
}  // namespace sandstroke
