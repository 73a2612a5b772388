#include "validation/study/study.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/error.h"

namespace sandstroke {
namespace {

TEST(ConvergenceOrder, IsTheExponentOfAPowerLawForCertain) {
  const ConvergenceOrder fit = fit_order({{1.0, 3.0}, {0.5, 0.75}, {0.25, 0.1875}, {0.125, 0.046875}});
  EXPECT_NEAR(fit.order, 2.0, 1e-14);
  EXPECT_NEAR(fit.low, 2.0, 1e-6);
  EXPECT_NEAR(fit.high, 2.0, 1e-6);
  EXPECT_EQ(fit.points, 4);
}

TEST(ConvergenceOrder, IsAsUncertainAsStudentSays) {
  // log2 error = x + (1, -2, 1) at x = -1, 0, 1: slope 1, residual variance 6 with one degree of freedom, and
  // sum x^2 = 2.
  const ConvergenceOrder fit = fit_order({{0.5, 1.0}, {1.0, 0.25}, {2.0, 4.0}});
  EXPECT_NEAR(fit.order, 1.0, 1e-14);
  EXPECT_NEAR(fit.high - fit.order, 12.706 * std::sqrt(3.0), 1e-3);
  EXPECT_NEAR(fit.order - fit.low, 12.706 * std::sqrt(3.0), 1e-3);
}

TEST(ConvergenceOrder, NeedsThreeDifferentSteps) {
  EXPECT_TRUE(std::isnan(fit_order({{1.0, 1.0}, {1.0, 2.0}, {0.5, 0.5}, {0.5, 0.4}}).order));
}

StudyRun run_of(const char* problem, double seconds, double error) {
  StudyRun run;
  run.problem = problem;
  run.wall_seconds = seconds;
  run.error = error;
  return run;
}

TEST(Pareto, FrontIsWhatNothingBeatsInBoth) {
  std::vector<StudyRun> runs = {run_of("a", 1.0, 1.0),
                                run_of("a", 2.0, 0.5),
                                run_of("a", 2.0, 0.6),
                                run_of("a", 3.0, 0.5),
                                run_of("a", 0.5, not_applicable),
                                run_of("b", 9.0, 9.0),
                                run_of("a", 1.0, 1.0)};
  mark_pareto(runs);
  std::vector<bool> front;
  for (const StudyRun& run : runs) front.push_back(run.pareto);
  EXPECT_EQ(front, (std::vector<bool>{true, true, false, false, false, true, true}));
}

TEST(Pareto, NoRunIsMoreExactThanTheReference) {
  std::vector<StudyRun> runs = {run_of("a", 1.0, 0.1), run_of("a", 2.0, 0.02), run_of("a", 3.0, 1e-9)};
  mark_pareto(runs, 0.02);
  EXPECT_TRUE(runs[0].pareto);
  EXPECT_TRUE(runs[1].pareto);
  EXPECT_FALSE(runs[2].pareto) << "below 0.02 nothing is known, and it is slower";
}

TEST(Disturbance, IsWhatRepeatsDifferByOrWaited) {
  EXPECT_FALSE(is_disturbed(1.0, 1.19, 0.0));
  EXPECT_TRUE(is_disturbed(1.0, 1.21, 0.0));
  EXPECT_FALSE(is_disturbed(1.0, 1.0, 0.19));
  EXPECT_TRUE(is_disturbed(1.0, 1.0, 0.21));  // all repeats waited alike
}

TEST(Disturbance, CountsForTheTickToCompareWithToo) {
  std::vector<StudyRun> runs = {run_of("ticks", 1.0, 2.0), run_of("ticks", 1.0, 4.0)};
  runs[0].settings.force_law = "paper";
  runs[1].settings.force_law = "rft";
  runs[0].disturbed = true;
  compare_ticks(runs);
  EXPECT_EQ(runs[1].of_paper, 2.0);
  EXPECT_TRUE(runs[1].disturbed);
}

TEST(QuickStudy, RunsEachContenderRepeatsItAndFitsItsOrder) {
  StudyOptions options;
  options.quick = true;
  options.problems = {"plunge"};
  options.repeats = 2;
  const Study study = run_study(options);
  ASSERT_EQ(study.problems.size(), 1u);
  EXPECT_EQ(study.runs.size(), study.problems[0].contenders.size());
  for (const StudyRun& run : study.runs) {
    EXPECT_GE(run.repeats, 1.0);  // only once where that takes long
    EXPECT_LE(run.repeats, 2.0);
    EXPECT_GT(run.wall_seconds, 0.0);
    EXPECT_LE(run.wall_seconds, run.median_seconds);
    EXPECT_LE(run.median_seconds, run.largest_seconds);
    EXPECT_EQ(run.error, run.score.work_error);
  }
  ASSERT_EQ(study.orders.size(), 1u);
  EXPECT_NEAR(study.orders[0].order, 1.0, 0.01);  // a force held for a tick is late by half of it
}

/// A study of the cliff with rules that leave the sand as it is, but tell this how many cells they met.
Study study_idle_peers(int repeats, double cells_visited,
                       const std::function<void(const char*, const HeightField&)>& tell) {
  StudyOptions options;
  options.quick = true;
  options.problems = {"cliff"};
  options.repeats = repeats;
  for (const char* name : {"one", "two"})
    options.peers.push_back({name, [=](HeightField& bed, double) {
                               tell(name, bed);
                               RelaxationOutcome outcome;
                               outcome.cells_visited = static_cast<std::int64_t>(cells_visited);
                               return outcome;
                             }});
  return run_study(options);
}

TEST(QuickStudy, PeersStandBesideTheOthers) {
  int found = 0;
  for (const StudyRun& run : study_idle_peers(1, 1.0, [](const char*, const HeightField&) {}).runs) {
    if (run.series != "one") continue;
    ++found;
    EXPECT_NEAR(run.error, 1.0, 1e-12);  // all that should move did not
  }
  EXPECT_EQ(found, 3);  // sizes
}

TEST(QuickStudy, RepeatsInTurnSoThatDriftHitsAllAlike) {
  std::vector<std::pair<std::string, int>> met;
  study_idle_peers(2, 1.0,
                   [&](const char* name, const HeightField& bed) { met.emplace_back(name, bed.cols()); });
  const std::vector<std::pair<std::string, int>> once = {{"one", 64}, {"one", 128}, {"one", 256},
                                                         {"two", 64}, {"two", 128}, {"two", 256}};
  std::vector<std::pair<std::string, int>> twice = once;
  twice.insert(twice.end(), once.begin(), once.end());
  EXPECT_EQ(met, twice);
}

TEST(QuickStudy, LeavesOutWhatWouldTakeTooLongAndSaysSo) {
  int largest = 0;
  const Study study = study_idle_peers(
      1, 1e7, [&](const char*, const HeightField& bed) { largest = std::max(largest, bed.cols()); });
  EXPECT_EQ(largest, 64);  // 1e7 cells with 64 are 1.6e8 with 128
  const auto noted = std::count_if(study.notes.begin(), study.notes.end(), [](const std::string& note) {
    return note.find("one, 128 cells") != std::string::npos ||
           note.find("one, 256 cells") != std::string::npos;
  });
  EXPECT_EQ(noted, 2);
}

TEST(QuickStudy, RefusesAProblemThatIsNotThere) {
  StudyOptions options;
  options.problems = {"plunge", "castle"};
  try {
    run_study(options);
    FAIL();
  } catch (const Error& failure) {
    EXPECT_EQ(failure.kind(), ErrorKind::input);
    EXPECT_NE(std::string(failure.what()).find("castle"), std::string::npos);
    EXPECT_NE(std::string(failure.what()).find("stroke-paper"), std::string::npos);
  }
}

}  // namespace
}  // namespace sandstroke
