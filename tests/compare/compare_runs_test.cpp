#include "compare/compare_runs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <tuple>

#include "core/error.h"
#include "synthetic_run.h"

namespace sandstroke {
namespace {

class CompareRuns : public testing::Test {
 protected:
  Comparison compare() {
    golden.write(folder / "golden.h5");
    run.write(folder / "run.h5");
    return compare_runs(RunFile(folder / "golden.h5"), RunFile(folder / "run.h5"), tolerances, coarsen);
  }

  void expect_only_failure(const std::string& name, const std::string& words) {
    sandstroke::expect_only_failure(compare(), name, words);
  }

  TestFolder folder;
  SyntheticRun golden, run;
  Tolerances tolerances;
  bool coarsen = false;
};

/// A surface on cells half as wide, whose means over 2 x 2 of them are the same.
HeightGrid refined(const HeightGrid& coarse) {
  return HeightGrid::NullaryExpr(
      2 * coarse.rows(), 2 * coarse.cols(), [&](Eigen::Index row, Eigen::Index col) {
        return coarse(row / 2, col / 2) + (row % 2 ? 0.01 : -0.01) + (col % 2 ? 0.003 : -0.003);
      });
}
void refine(SyntheticRun& run) {
  run.cell_size /= 2.0;
  run.initial = refined(run.initial);
  run.final = refined(run.final);
}

TEST_F(CompareRuns, AFinerBedIsComparedInMeansWhereThatIsAskedFor) {
  refine(run);
  for (int turn = 0; turn < 2; ++turn, std::swap(golden, run)) {
    const std::string finer = turn == 0 ? "the run" : "golden";
    coarsen = false;
    const Comparison refused = compare();
    EXPECT_EQ(refused.failures(), 3);
    EXPECT_NE(check_table(refused).find("; --coarsen compares means of 2 x 2 cells of " + finer + "\n"),
              std::string::npos)
        << check_table(refused);
    coarsen = true;
    const Comparison comparison = compare();
    EXPECT_TRUE(comparison.passed()) << check_table(comparison);
    EXPECT_EQ(comparison.checks[2].sentence,
              "coarsened to cells of 0.01 m: means of 2 x 2 cells of " + finer + " are compared");
  }
}

TEST_F(CompareRuns, AFinerCellCountsByItsPartOfTheMean) {
  refine(run);
  coarsen = true;
  run.final(11, 15) += 4.0 * 0.95e-6;
  EXPECT_TRUE(compare().passed());
  run.final(11, 15) += 4.0 * 0.1e-6;
  expect_only_failure("final height", "row 5, col 7 (x = -0.125 m, y = -0.095 m)");
  run.initial(59, 79) -= 4.0 * 1.05e-6;
  EXPECT_EQ(compare().failures(), 2);
}

TEST_F(CompareRuns, BedsThatDoNotFitAreNotCoarsened) {
  const auto bed = [&](Eigen::Index rows, Eigen::Index cols, double cell_size) {
    run.initial = run.final = HeightGrid::Zero(rows, cols);
    run.cell_size = cell_size;
  };
  for (const auto& [rows, cols, cell_size] : {std::tuple{45, 60, 0.01 / 1.5},
                                              {60, 80, 0.004},
                                              {60, 81, 0.005},
                                              {61, 80, 0.005},
                                              {60, 120, 0.005}}) {
    bed(rows, cols, cell_size);
    coarsen = false;
    EXPECT_EQ(check_table(compare()).find("--coarsen"), std::string::npos) << "not suggested";
    coarsen = true;
    const Comparison comparison = compare();
    EXPECT_EQ(comparison.failures(), 3) << rows << " x " << cols;
    EXPECT_NE(check_table(comparison).find("; --coarsen has no effect: the beds differ in size"),
              std::string::npos)
        << check_table(comparison);
  }
}

TEST(Verdict, IsOneLine) {
  const Check good = passed_check("cell size", ""), bad = failed_check("force", "");
  EXPECT_EQ(verdict({"run", {good}}), "same within the tolerances");
  EXPECT_EQ(verdict({"run", {bad, good, failed_check("final height", "")}}), "differs: force, final height");
}

TEST_F(CompareRuns, AFileEqualsItself) {
  const Comparison comparison = compare();
  EXPECT_TRUE(comparison.passed()) << check_table(comparison);
  std::vector<std::string> names;
  for (const Check& check : comparison.checks) names.push_back(check.name);
  EXPECT_EQ(names, (std::vector<std::string>{"golden complete", "run complete", "cell size", "initial height",
                                             "final height", "frames", "ticks", "time", "force", "depth",
                                             "level", "finite positions"}));
}

TEST_F(CompareRuns, OneChangedCellFailsAndIsNamed) {
  run.final(5, 7) += 2e-6;
  expect_only_failure("final height", "row 5, col 7 (x = -0.125 m, y = -0.095 m)");
}

TEST_F(CompareRuns, OneChangedInitialCellFails) {
  run.initial(29, 39) -= 2e-6;
  expect_only_failure("initial height", "row 29, col 39");
}

TEST_F(CompareRuns, ToleranceOfHeightHoldsAtItsLimit) {
  tolerances.height = 0x1p-20;
  run.final(0, 0) = 0x1p-20;
  EXPECT_TRUE(compare().passed());
  run.final(0, 0) = 0x1.0000000000001p-20;
  expect_only_failure("final height", "row 0, col 0");
  EXPECT_EQ(compare().checks[4].measured, 0x1.0000000000001p-20);
}

TEST_F(CompareRuns, ToleranceOfForceHoldsAtItsLimit) {
  tolerances.force = 0x1p-13;
  golden.trace[40].device_force.x() = 1.0;
  run.trace[40].device_force.x() = 1.0 + 0x1p-13;
  EXPECT_TRUE(compare().passed());
  run.trace[40].device_force.x() = 1.0 + 0x1.01p-13;
  expect_only_failure("force", "at time 0.04 s");
}

TEST_F(CompareRuns, ToleranceOfDepthAndLevelHoldsAtItsLimit) {
  tolerances.depth = 0x1p-20;
  golden.trace[33].depth = golden.trace[34].level = 0.5;
  run.trace[33].depth = run.trace[34].level = 0.5 - 0x1p-20;
  EXPECT_TRUE(compare().passed());
  run.trace[33].depth = 0.5 - 0x1.01p-20;
  expect_only_failure("depth", "at time 0.033 s");
  run.trace[33].depth = 0.5;
  run.trace[34].level = 0.5 - 0x1.01p-20;
  expect_only_failure("level", "at time 0.034 s");
}

TEST_F(CompareRuns, DifferentShapesFail) {
  run.initial = HeightGrid::Zero(30, 41);
  run.final = run.initial;
  const Comparison comparison = compare();
  EXPECT_EQ(comparison.failures(), 2);
  EXPECT_NE(comparison.checks[4].sentence.find("40 x 30 cells (x, y) of 0.01 m, the run 41 x 30 of 0.01 m"),
            std::string::npos);
}

TEST_F(CompareRuns, DifferentCellSizesFail) {
  run.cell_size = 0.0100001;
  const Comparison comparison = compare();
  EXPECT_EQ(comparison.failures(), 3);  // cells at other places are not compared
  for (const char* name : {"cell size", "initial height", "final height"}) {
    const auto same_name = [&](const Check& check) { return check.name == name; };
    const auto found = std::find_if(comparison.checks.begin(), comparison.checks.end(), same_name);
    EXPECT_FALSE(found->passed) << name;
    EXPECT_NE(found->sentence.find("0.0100001 m"), std::string::npos) << found->sentence;
  }
}

TEST_F(CompareRuns, ATraceInOnlyOneFails) {
  run.has_trace = false;
  expect_only_failure("trace", "the run has no trace");
  run.has_trace = true;
  golden.has_trace = false;
  expect_only_failure("trace", "golden has no trace");
  run.has_trace = false;
  EXPECT_TRUE(compare().passed()) << "scenes without trace";
}

TEST_F(CompareRuns, AMissingColumnFails) {
  run.missing_column = "depth";
  expect_only_failure("trace", "/trace/depth");
}

TEST_F(CompareRuns, AMissingTickFails) {
  run.trace.pop_back();
  expect_only_failure("ticks", "golden has 105 ticks, the run 104");
}

TEST_F(CompareRuns, AnotherServoRateFails) {
  for (TickRecord& tick : run.trace) tick.time *= 2.0;
  expect_only_failure("time", "at time 0.104 s");
}

TEST_F(CompareRuns, AnIncompleteRunFails) {
  run.complete = false;
  expect_only_failure("run complete", "was cut off");
  run.has_final = false;
  EXPECT_EQ(compare().failures(), 2);
  run.complete = true;
  expect_only_failure("final height", "/surface/final");
}

TEST_F(CompareRuns, OneNanFails) {
  run.final(12, 3) = std::numeric_limits<double>::quiet_NaN();
  expect_only_failure("final height", "not a number at row 12, col 3");
  golden.final = run.final;
  expect_only_failure("final height", "not a number at row 12, col 3");
}

TEST_F(CompareRuns, OneNanInTheForceFails) {
  run.trace[100].device_force.z() = std::numeric_limits<double>::quiet_NaN();
  expect_only_failure("force", "not a number at time 0.1 s");
}

TEST_F(CompareRuns, OneNanInAPositionFails) {
  run.trace[50].device_position.y() = std::numeric_limits<double>::quiet_NaN();
  expect_only_failure("finite positions", "the run: not a number at time 0.05 s");
  run.trace[50].device_position.y() = 0.0;
  run.trace[100].hand.position.x() = std::numeric_limits<double>::infinity();
  expect_only_failure("finite positions", "the run: not a number at time 0.1 s");
  std::swap(run.trace, golden.trace);
  expect_only_failure("finite positions", "golden: not a number at time 0.1 s");
}

TEST_F(CompareRuns, WhatIsNoRunFileIsBadInput) {
  Hdf5Writer file(folder / "other.h5");
  file.attribute("/", "format", "sandstroke.stroke");
  file.finish();
  EXPECT_THROW(RunFile(folder / "other.h5"), Error);
}

TEST(Comparison, IsAsBadAsItsWorstCheck) {
  EXPECT_EQ(
      (Comparison{"run", {limit_check("a", 0.5, 1.0, "m", ""), limit_check("b", 3.0, 4.0, "N", "")}}.worst()),
      0.75);
  EXPECT_EQ((Comparison{"run", {limit_check("a", 6.0, 4.0, "m", ""), passed_check("b", "")}}.worst()), 1.5);
  EXPECT_TRUE(std::isinf(Comparison{"run", {failed_check("a", "")}}.worst()));
}

TEST(Comparison, HasNotPassedWithoutChecks) { EXPECT_FALSE(Comparison{}.passed()); }

TEST(CheckTable, IsAlignedAndExplainsWhatFailed) {
  const Comparison comparison{"run",
                              {limit_check("height", 1e-7, 1e-6, "m", "fine"),
                               limit_check("a long name", 2.5, 1e-4, "N", "differs by 2.5 N")}};
  EXPECT_EQ(check_table(comparison),
            "check        measured  limit\n"
            "height       1e-07 m   1e-06 m   ok\n"
            "a long name  2.5 N     0.0001 N  FAILED\n"
            "a long name: differs by 2.5 N\n");
}

TEST(CheckJson, HasNullForWhatIsNotANumber) {
  const nlohmann::json json = nlohmann::json::parse(to_json({"run", {failed_check("trace", "none")}}).dump());
  EXPECT_EQ(json["passed"], false);
  EXPECT_TRUE(json["checks"][0]["measured"].is_null());
  EXPECT_EQ(json["checks"][0]["sentence"], "none");
}

/// A change of a run, and the check that judges it.
struct ToleranceCase {
  std::string check;
  double limit;
  std::function<void(SyntheticRun&, double)> change;
};

TEST_F(CompareRuns, EachToleranceHoldsJustBelowItAndNotJustAbove) {
  const std::vector<ToleranceCase> cases = {
      {"initial height", 1e-6, [](SyntheticRun& r, double by) { r.initial(3, 38) += by; }},
      {"final height", 1e-6, [](SyntheticRun& r, double by) { r.final(29, 0) += by; }},
      {"force", 1e-4, [](SyntheticRun& r, double by) { r.trace[5].device_force.x() += by; }},
      {"force", 1e-4, [](SyntheticRun& r, double by) { r.trace[50].device_force.y() += by; }},
      {"force", 1e-4, [](SyntheticRun& r, double by) { r.trace[104].device_force.z() += by; }},
      {"force", 1e-4,
       [](SyntheticRun& r, double by) {
         r.trace[50].device_force += by * Eigen::Vector3d(0.48, 0.64, -0.6);
       }},
      {"depth", 1e-6, [](SyntheticRun& r, double by) { r.trace[70].depth += by; }},
      {"level", 1e-6, [](SyntheticRun& r, double by) { r.trace[70].level += by; }},
      {"time", 1e-9, [](SyntheticRun& r, double by) { r.trace[70].time += by; }}};
  double sign = 1.0;
  for (const ToleranceCase& one : cases) {
    sign = -sign;
    run = SyntheticRun();
    one.change(run, 0.95 * sign * one.limit);
    EXPECT_TRUE(compare().passed()) << one.check;
    run = SyntheticRun();
    one.change(run, -1.05 * sign * one.limit);
    expect_only_failure(one.check, "differs by ");
  }
}

TEST_F(CompareRuns, CellSizesAreTheSameUpToRounding) {
  for (const double sign : {1.0, -1.0}) {
    run.cell_size = golden.cell_size * (1.0 + 0.95e-12 * sign);
    EXPECT_TRUE(compare().passed());
    run.cell_size = golden.cell_size * (1.0 + 1.05e-12 * sign);
    EXPECT_EQ(compare().failures(), 3);  // with both surfaces, whose cells lie elsewhere
  }
}

TEST_F(CompareRuns, SaysHowFarApartTheyAreInEachQuantity) {
  tolerances = {1.0, 2.0, 3.0};
  run.final(5, 7) += 0.25;
  run.initial(5, 8) += 0.125;
  run.trace[40].device_force.y() += 0.5;
  run.trace[41].depth += 0.0625;
  run.trace[42].level -= 0.03125;
  run.trace.pop_back();
  const Comparison comparison = compare();
  const auto found = [&](const std::string& name) {
    for (const Check& check : comparison.checks)
      if (check.name == name) return check;
    return Check{};
  };
  for (const auto& [name, measured, limit, unit] : {std::tuple{"initial height", 0.125, 1.0, "m"},
                                                    {"final height", 0.25, 1.0, "m"},
                                                    {"force", 0.5, 2.0, "N"},
                                                    {"depth", 0.0625, 3.0, "m"},
                                                    {"level", 0.03125, 3.0, "m"},
                                                    {"time", 0.0, 1e-9, "s"},
                                                    {"ticks", 104.0, 105.0, ""}}) {
    EXPECT_DOUBLE_EQ(found(name).measured, measured) << name;
    EXPECT_EQ(found(name).limit, limit) << name;
    EXPECT_EQ(found(name).unit, unit) << name;
  }
  const nlohmann::json json = to_json(comparison);
  EXPECT_EQ(json["name"], comparison.name);
  for (std::size_t i = 0; i < comparison.checks.size(); ++i) {
    const Check& check = comparison.checks[i];
    EXPECT_EQ(json["checks"][i]["name"], check.name);
    EXPECT_EQ(json["checks"][i]["passed"], check.passed);
    EXPECT_EQ(json["checks"][i]["unit"], check.unit);
    EXPECT_EQ(json["checks"][i]["sentence"], check.sentence);
    if (std::isnan(check.limit)) continue;
    EXPECT_EQ(json["checks"][i]["measured"], check.measured);
    EXPECT_EQ(json["checks"][i]["limit"], check.limit);
  }
  EXPECT_NE(found("final height").sentence.find("RMS 0.00721688 m, volume +2.5e-05 m^3"), std::string::npos)
      << found("final height").sentence;  // 0.25 m / sqrt(1200); 0.25 m x (10 mm)^2
}

TEST_F(CompareRuns, FloorsAreComparedWhereThereIsOne) {
  const auto names = [](const Comparison& comparison) {
    std::vector<std::string> all;
    for (const Check& check : comparison.checks) all.push_back(check.name);
    return all;
  };
  const std::vector<std::string> without = names(compare());
  EXPECT_EQ(std::count(without.begin(), without.end(), "floor"), 0);
  HeightGrid floor = HeightGrid::Constant(30, 40, std::numeric_limits<double>::quiet_NaN());
  floor.block(3, 3, 4, 4) = -0.125;
  run.floor = floor;
  expect_only_failure("floor",
                      "the run has stones or another floor under its sand, but the other one has none");
  std::swap(golden, run);
  expect_only_failure("floor", "golden has stones");
  run.floor = floor;
  EXPECT_TRUE(compare().passed());
  run.floor(4, 5) += 0.9e-6;
  EXPECT_TRUE(compare().passed());
  run.floor(4, 5) = -0.124;
  expect_only_failure("floor", "differs by 0.001 m");
  run.floor(4, 5) = std::numeric_limits<double>::quiet_NaN();
  expect_only_failure("floor", "is under the sand in one of the runs only in 1 of 1200 cells");
}

}  // namespace
}  // namespace sandstroke
