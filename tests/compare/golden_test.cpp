#include "compare/golden.h"

#include <cmath>
#include <fstream>
#include <functional>
#include <map>
#include <tuple>

#include "core/error.h"
#include "core/input_file.h"
#include "core/output_file.h"
#include "core/stopwatch.h"
#include "golden_fixture.h"

namespace sandstroke {
namespace {
namespace fs = std::filesystem;

TEST_F(Golden, RoundTripPasses) {
  write_golden(folder / "golden/dune", finished());
  const Comparison comparison = compare();
  EXPECT_TRUE(comparison.passed()) << check_table(comparison);
  std::vector<std::string> names;
  for (const Check& check : comparison.checks) names.push_back(check.name);
  EXPECT_EQ(names,
            (std::vector<std::string>{"run complete", "volume drift", "stroke", "scene", "initial surface",
                                      "cell size", "height change", "ticks", "time", "force", "depth",
                                      "level", "finite positions", "picture", "picture share"}));
}

TEST_F(Golden, WhatAKilledUpdateLeftIsNoEntryAndInNobodysWay) {
  fs::create_directories(folder / "golden/dune.new.part");
  put_text(folder / "golden/dune.new.part/golden.h5", "half");
  put_text(folder / "golden/dune.part", "");    // its lock
  for (int update = 0; update < 2; ++update) {  // where there is no entry, and where there is one
    write_golden(folder / "golden/dune", finished());
    EXPECT_TRUE(compare().passed());
    EXPECT_EQ(std::distance(fs::directory_iterator(folder / "golden"), fs::directory_iterator()), 1);
  }
}

TEST_F(Golden, IsNotWrittenByTwoAtATime) {
  write_golden(folder / "golden/dune", finished());
  const FileLock writing = take_part(folder / "golden/dune", {});
  EXPECT_THROW(write_golden(folder / "golden/dune", finished()), Error);
  EXPECT_TRUE(compare().passed());
}

TEST_F(Golden, SandThatIsLostOrMadeFails) {
  write_golden(folder / "golden/dune", finished());
  GoldenRun leaking = finished();
  leaking.result.volume_drift = 2e-12;
  EXPECT_FALSE(compare_golden(entry(), leaking, Tolerances{}).passed());
}

TEST_F(Golden, AChangeOfOneTickFailsAtItsTime) {
  write_golden(folder / "golden/dune", finished());
  const std::vector<TickRecord> trace = run.trace;
  using Change = std::function<void(TickRecord&)>;
  const std::vector<std::pair<std::string, Change>> changes = {
      {"force", [](TickRecord& tick) { tick.device_force.x() += 0.001; }},
      {"force", [](TickRecord& tick) { tick.device_force.y() -= 0.001; }},
      {"force", [](TickRecord& tick) { tick.device_force.z() += 0.001; }},
      {"depth", [](TickRecord& tick) { tick.depth -= 2e-6; }}};
  for (const std::size_t tick : {0, 1, 9, 11, 19, 20, 47, 103, 104}) {
    for (const auto& [check, change] : changes) {
      run.trace = trace;
      change(run.trace[tick]);
      expect_only_failure(check, fmt::format("at time {} s", trace[tick].time));
    }
  }
}

TEST_F(Golden, ASpikeOfOneTickIsReportedAsLargeAsItIs) {
  write_golden(folder / "golden/dune", finished());
  run.trace[47].device_force.y() += 10.57;
  for (const Check& check : compare().checks)
    if (check.name == "force") {
      EXPECT_NEAR(check.measured, 10.57, 0x1p-17) << check.sentence;
    }
  expect_only_failure("force", "at time 0.047 s");
}

TEST_F(Golden, EachToleranceHoldsJustBelowItAndNotJustAbove) {
  write_golden(folder / "golden/dune", finished());
  using Change = std::function<void(double)>;
  const std::vector<std::tuple<std::string, double, Change>> cases = {
      {"height change", 1e-6, [&](double by) { run.final(12, 25) += by; }},
      {"height change", 1e-6, [&](double by) { run.final(0, 39) += by; }},  // not in the block that is kept
      {"force", 1e-4, [&](double by) { run.trace[90].device_force.x() += by; }},
      {"depth", 1e-6, [&](double by) { run.trace[90].depth += by; }},
      {"level", 1e-6, [&](double by) { run.trace[90].level += by; }}};
  double sign = 1.0;
  for (const auto& [check, limit, change] : cases) {
    sign = -sign;
    run = SyntheticRun();
    change(0.95 * sign * limit);
    EXPECT_TRUE(compare().passed()) << check;
    run = SyntheticRun();
    change(-1.05 * sign * limit);
    expect_only_failure(check, "differs by ");
  }
  run = SyntheticRun();
  for (const auto& [drift, passed] : {std::pair{0.95e-12, true}, {1.05e-12, false}}) {
    GoldenRun leaking = finished();
    leaking.result.volume_drift = drift;
    EXPECT_EQ(compare_golden(entry(), leaking, Tolerances{}).passed(), passed);
  }
}

TEST_F(Golden, TheLastBitsOfTheInitialSurfaceDoNotMatter) {
  write_golden(folder / "golden/dune", finished());
  run.initial += 1e-12;
  run.final += 1e-12;
  EXPECT_TRUE(compare().passed()) << check_table(compare());
}

TEST_F(Golden, SaysWhatItRanAndWhatCameOut) {
  GoldenRun ran = finished();
  ran.result.ticks = 105;
  ran.result.relaxation.passes = 77;
  ran.result.relaxation.residual = 5e-4;
  ran.result.volume_drift = 3e-14;
  write_golden(folder / "golden/dune", ran);
  std::map<std::string, std::string> said;
  for (const auto& [name, value] : golden_provenance(entry())) said[name] = value;
  EXPECT_EQ(said["scene_hash"], run.scene_hash);
  EXPECT_EQ(said["stroke_hash"], run.stroke_hash);
  EXPECT_EQ(said.size(), 5u);  // with version, commit and compiler
  const std::string text = read_text_file(folder / "golden/dune/provenance.toml");
  for (const char* line :
       {"ticks = 105\n", "passes = 77\n", "residual = 5.000e-04\n", "volume_drift = 3.000e-14\n"})
    EXPECT_NE(text.find(line), std::string::npos) << text;
}

TEST_F(Golden, AnyOneCellFailsWithin2Micrometres) {
  write_golden(folder / "golden/dune", finished());
  const SyntheticRun golden = run;
  for (int row = 0; row < 30; ++row) {
    for (int col = row % 7; col < 40; col += 7) {
      run.final(row, col) += row % 2 ? 2e-6 : -2e-6;
      expect_only_failure("height change", fmt::format("row {}, col {} ", row, col));
      run.final = golden.final;
    }
  }
}

TEST_F(Golden, ASlightDifferencePasses) {
  write_golden(folder / "golden/dune", finished());
  run.final += 9e-7;
  EXPECT_TRUE(compare().passed());
}

TEST_F(Golden, AnotherInitialSurfaceFails) {
  write_golden(folder / "golden/dune", finished());
  run.initial(2, 2) += 1e-6;  // and the same change
  run.final(2, 2) += 1e-6;
  expect_only_failure("initial surface", "golden update dune");
}

TEST_F(Golden, AnotherShapeFails) {
  write_golden(folder / "golden/dune", finished());
  run.initial = run.final = HeightGrid::Zero(30, 41);
  const Comparison comparison = compare();
  EXPECT_NE(check_table(comparison).find("40 x 30 cells (x, y) of 0.01 m, the run 41 x 30 of 0.01 m"),
            std::string::npos);
}

TEST_F(Golden, OneForceFails) {
  write_golden(folder / "golden/dune", finished());
  run.trace[90].device_force.y() += 2e-4;
  expect_only_failure("force", "at time 0.09 s");
}

TEST_F(Golden, AMissingTickOrTraceFails) {
  write_golden(folder / "golden/dune", finished());
  run.trace.pop_back();
  expect_only_failure("ticks", "golden has 105 ticks, the run 104");
  run.has_trace = false;
  expect_only_failure("trace", "the run has no trace");
}

TEST_F(Golden, TicksAreThoseOfTheWholeRun) {
  write_golden(folder / "golden/dune", finished());
  for (const Check& check : compare().checks)
    if (check.name == "ticks") {
      EXPECT_EQ(check.measured, 105.0);
      EXPECT_EQ(check.limit, 105.0);
    }
  run.trace.push_back(run.trace.back());
  expect_only_failure("ticks", "golden has 105 ticks, the run 106");
}

TEST_F(Golden, AChangedPictureFails) {
  write_golden(folder / "golden/dune", finished());
  for (int y = 8; y < 16; ++y)
    for (int x = 8; x < 16; ++x) picture.pixel(x, y)[1] = 30;
  expect_only_failure("picture", "x = 8, y = 8");
  picture = Image(720, 404);
  expect_only_failure("picture", "720 x 404");
}

TEST_F(Golden, AChangedSceneNamesItsSettingsWithBothValues) {
  run.scene =
      "[device]\nservo_rate = 1000.0\n[tool]\nradius = 0.01\nprofile = \"paper\"\n[view]\nsize = [80, 45]\n";
  write_golden(folder / "golden/dune", finished());
  run.scene = "[device]\nservo_rate = 1000.0\n[tool]\nradius = 0.02\nsolid = true\n[view]\nsize = [80, 46]\n";
  expect_only_failure("scene",
                      "changed: tool.radius was 0.01, is 0.02; tool.profile was \"paper\", is gone; "
                      "view.size was [80, 45], is [80, 46]; tool.solid is new, true; "
                      "if this change is intended, run: sandstroke golden update dune");
}

TEST_F(Golden, ASettingThatTheEntrysBuildDidNotHaveHadItsDefault) {
  run.scene = "[tool]\nradius = 0.02\n[stroke]\nfile = \"hand.h5\"\n";
  write_golden(folder / "golden/dune", finished());
  run.scene += "rotate_z = 0.0\n";
  EXPECT_TRUE(compare().passed());
  run.scene += "depth = 0.001\n";
  expect_only_failure("scene", "changed: stroke.depth is new, 0.001;");
}

TEST_F(Golden, ASettingThatIsGoneAndAskedForNothingIsNoDifference) {
  const std::string scene = "[tool]\nradius = 0.02\n[relaxation]\nrate = 60.0\n";
  run.scene = scene + "travel = 0.0\n";
  write_golden(folder / "golden/dune", finished());
  run.scene = scene + "way = 0.0\n";
  EXPECT_TRUE(compare().passed());
}

TEST_F(Golden, AChangedStrokeNamesItsFile) {
  run.scene += "[stroke]\nfile = \"hand.h5\"\n";
  write_golden(folder / "golden/dune", finished());
  run.stroke_hash = "";
  expect_only_failure("stroke",
                      "changed: hand.h5 holds another stroke; if this change is intended, run: sandstroke "
                      "golden update dune");
}

TEST_F(Golden, WhatPassesDoesNotSayThatItFailed) {
  write_golden(folder / "golden/dune", finished());
  run.final(12, 25) += 5e-7;
  GoldenRun ran = finished();
  ran.result.volume_drift = 3e-17;
  const Comparison comparison = compare_golden(entry(), ran, Tolerances{});
  for (const Check& check : comparison.checks)
    for (const char* word : {"changed", "every step", "must", "golden update"})
      EXPECT_EQ(check.sentence.find(word), std::string::npos) << check.name << ": " << check.sentence;
  for (const Check& check : comparison.checks)
    if (check.measured == 0.0 && check.name != "cell size") {
      EXPECT_EQ(check.sentence.find("differs"), std::string::npos) << check.name << ": " << check.sentence;
    }
  ran.result.volume_drift = 3e-9;
  sandstroke::expect_only_failure(compare_golden(entry(), ran, Tolerances{}), "volume drift",
                                  "every step must keep the volume");
}

TEST_F(Golden, TheRunsTimeIsThatOfItsCheckAndNothingIsCountedTwice) {
  write_golden(folder / "golden/dune", finished());
  GoldenRun ran = finished();
  ran.seconds = 1000.0;
  const Stopwatch watch;
  const Comparison comparison = compare_golden(entry(), ran, Tolerances{});
  const double took = watch.seconds();
  double sum = 0.0;
  for (const Check& check : comparison.checks) {
    EXPECT_GE(check.seconds, 0.0) << check.name;
    if (check.name == "run complete") {
      EXPECT_EQ(check.seconds, 1000.0);
    }
    sum += check.seconds;
  }
  EXPECT_EQ(comparison.seconds(), sum);
  EXPECT_GT(sum, 1000.0) << "comparing takes time, too";
  EXPECT_LE(sum, 1000.0 + took);
}

TEST_F(Golden, AnEntryWithoutOneOfItsFilesFails) {
  for (const char* file : {"golden.h5", "picture.png", "provenance.toml"}) {
    write_golden(folder / "golden/dune", finished());
    fs::remove(folder / "golden/dune" / file);
    EXPECT_EQ(compare().failures(), 1);
    EXPECT_NE(check_table(compare()).find(std::string(file) + ": is missing"), std::string::npos);
  }
}

TEST_F(Golden, AnUnchangedSurfaceAndNoTraceAreFine) {
  run.final = run.initial;
  run.has_trace = false;
  write_golden(folder / "golden/dune", finished());
  EXPECT_TRUE(compare().passed());
  run.final(7, 7) = 2e-6;
  expect_only_failure("height change", "row 7, col 7");
}

TEST_F(Golden, OnlyACompleteFiniteRunBecomesGolden) {
  write_golden(folder / "golden/dune", finished());
  run.final(1, 1) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(write_golden(folder / "golden/dune", finished()), Error);
  run = SyntheticRun();
  run.complete = false;
  EXPECT_THROW(write_golden(folder / "golden/dune", finished()), Error);
  run.complete = true;
  EXPECT_TRUE(compare().passed()) << "what was there has stayed";
}

TEST_F(Golden, UpdateReplacesItsFilesAndLeavesNothingBeside) {
  write_golden(folder / "golden/dune", finished());
  std::ofstream(folder / "golden/dune/stray.txt") << "old";
  fs::create_directories(folder /
                         "golden/dune.new.part/golden.h5.part");  // left by an update that was killed
  run.final(0, 0) = 0.001;
  write_golden(folder / "golden/dune", finished());
  EXPECT_TRUE(compare().passed());
  EXPECT_EQ(read_text_file(folder / "golden/dune/stray.txt"), "old");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder / "golden/dune"), fs::directory_iterator()), 4);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder / "golden"), fs::directory_iterator()), 1);
}

TEST_F(Golden, IsReproducible) {
  write_golden(folder / "a", finished());
  write_golden(folder / "b", finished());
  EXPECT_EQ(read_text_file(folder / "a/provenance.toml"), read_text_file(folder / "b/provenance.toml"));
  EXPECT_EQ(read_text_file(folder / "a/picture.png"), read_text_file(folder / "b/picture.png"));
}

}  // namespace
}  // namespace sandstroke
