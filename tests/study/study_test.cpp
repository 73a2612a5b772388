#include "study/study.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "core/error.h"
#include "core/output_file.h"
#include "io/hdf5_reader.h"
#include "study/study_files.h"
#include "study/study_table.h"
#include "test_folder.h"

namespace sandstroke {
namespace {

TEST(ConvergenceOrder, OfAPowerLawIsItsExponentForCertain) {
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
  run.problem = problem, run.wall_seconds = seconds, run.error = error;
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

class QuickStudy : public testing::Test {
 protected:
  static Study plunge() {
    StudyOptions options;
    options.quick = true;
    options.problems = {"plunge"};
    options.repeats = 2;
    return run_study(options);
  }
};

TEST_F(QuickStudy, RunsEachContenderRepeatsItAndFitsItsOrder) {
  const Study study = plunge();
  ASSERT_EQ(study.problems.size(), 1u);
  EXPECT_EQ(study.runs.size(), study.problems[0].contenders.size());
  for (const StudyRun& run : study.runs) {
    EXPECT_EQ(run.repeats, 2.0);
    EXPECT_LE(run.least_seconds, run.wall_seconds);
    EXPECT_LE(run.wall_seconds, run.largest_seconds);
    EXPECT_EQ(run.error, run.score.work_error);
  }
  ASSERT_EQ(study.orders.size(), 1u);
  EXPECT_NEAR(study.orders[0].order, 1.0, 0.01);  // a force held for a tick is late by half of it
  EXPECT_TRUE(study.notes.empty());
}

TEST_F(QuickStudy, PeersStandBesideTheOthers) {
  StudyOptions options;
  options.quick = true;
  options.problems = {"cliff"};
  options.repeats = 1;
  options.peers = {{"nothing", [](HeightField&, double) { return RelaxationOutcome{}; }}};
  const Study study = run_study(options);
  int found = 0;
  for (const StudyRun& run : study.runs) {
    if (run.series != "nothing") continue;
    ++found;
    EXPECT_NEAR(run.error, 1.0, 1e-12);  // all that should move did not
  }
  EXPECT_GT(found, 1);
}

TEST_F(QuickStudy, RefusesAProblemThatIsNotThere) {
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

TEST_F(QuickStudy, LeavesPageTableAndDataThatSayTheSame) {
  Study study = plunge();
  study.estimates.push_back({"plunge", "a", "force", 2.0, 1.0});
  study.notes = {"left out"};
  const nlohmann::ordered_json json = study_json(study);
  EXPECT_EQ(json["runs"].size(), study.runs.size());
  for (const auto& column : json["columns"])
    EXPECT_TRUE(json["runs"][0].contains(column["name"].get<std::string>())) << column["name"];
  EXPECT_TRUE(json["runs"][0]["l1"].is_null());
  EXPECT_TRUE(json["runs"][0]["pareto"].is_boolean());
  EXPECT_TRUE(json["problems"][0]["converged_to"].is_null());
  EXPECT_EQ(json["estimates"][0]["ratio"], 2.0);
  EXPECT_EQ(json["notes"][0], "left out");

  const TestFolder folder;
  const StudyFiles files(folder / "new/folder");
  files.write(study);
  const std::string csv = read_text_file(folder / "new/folder/bench.csv");
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), static_cast<int>(study.runs.size()) + 1);
  const Hdf5Reader data(folder / "new/folder/bench.h5");
  const std::vector<double> errors = data.doubles("/runs/work_error");
  for (std::size_t i = 0; i < study.runs.size(); ++i) EXPECT_EQ(errors[i], study.runs[i].error);
  EXPECT_EQ(data.text_attribute("/runs/wall_seconds", "unit"), "s");
  EXPECT_EQ(data.grid("/slope_error").rows(), static_cast<int>(study.runs.size()));
  EXPECT_NE(read_text_file(files.page()).find("Work of a plunge"), std::string::npos);
}

TEST(StudyFilesTest, APlaceThatCannotBeWrittenIsRefusedAtOnce) {
  const TestFolder folder;
  std::ofstream(folder / "file") << "text";
  try {
    StudyFiles(folder / "file");
    FAIL();
  } catch (const Error& failure) {
    EXPECT_EQ(failure.kind(), ErrorKind::io);
  }
}

}  // namespace
}  // namespace sandstroke
