#include "compare/golden.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <functional>
#include <map>
#include <tuple>

#include "compare/golden_scenes.h"
#include "core/error.h"
#include "core/input_file.h"
#include "core/machine.h"
#include "core/output_file.h"
#include "core/stopwatch.h"
#include "io/input_kind.h"
#include "synthetic_run.h"

namespace sandstroke {
namespace {
namespace fs = std::filesystem;

class Golden : public testing::Test {
 protected:
  Golden() {
    for (int y = 0; y < picture.height; ++y)
      for (int x = 0; x < picture.width; ++x) picture.pixel(x, y)[0] = static_cast<std::uint8_t>(x % 256);
  }

  GoldenRun finished() {
    run.write(folder / "run.h5");
    return {folder / "run.h5", picture, {}};
  }
  Comparison compare() { return compare_golden(entry(), finished(), Tolerances{}); }

  GoldenEntry entry() const { return {"dune", folder / "golden/dune", "sandstroke golden update dune"}; }

  void expect_only_failure(const std::string& name, const std::string& words) {
    sandstroke::expect_only_failure(compare(), name, words);
  }
  /// A golden.h5 that says what it wants of a bed whose changed block is given.
  void claim(double rows, double cols, double cell_size, double servo_rate, const HeightGrid& block) {
    Hdf5Writer file(folder / "golden/dune/golden.h5", output_kind(InputKind::golden));
    file.attribute("/", "format_version", 2.0);
    file.write("/scene", run.scene);
    file.make_group("/surface");
    file.attribute("/surface", "rows", rows);
    file.attribute("/surface", "cols", cols);
    file.attribute("/surface", "cell_size", cell_size);
    file.attribute("/surface", "initial_hash", "");
    file.write("/surface/change", block);
    file.attribute("/surface/change", "row", 0.0);
    file.attribute("/surface/change", "col", 0.0);
    file.make_group("/trace");
    file.attribute("/trace", "servo_rate", servo_rate);
    file.write("/trace/ticks", HeightGrid::Zero(7, 1));
    file.finish();
  }

  TestFolder folder;
  SyntheticRun run;
  Image picture = Image(720, 405);
};

TEST_F(Golden, RoundTripPasses) {
  write_golden(folder / "golden/dune", finished());
  const Comparison comparison = compare();
  EXPECT_TRUE(comparison.passed()) << check_table(comparison);
  std::vector<std::string> names;
  for (const Check& check : comparison.checks) names.push_back(check.name);
  EXPECT_EQ(names,
            (std::vector<std::string>{"run complete", "volume drift", "stroke", "scene", "initial surface",
                                      "cell size", "height change", "ticks", "time", "force", "depth",
                                      "level", "positions", "picture", "picture share"}));
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

TEST_F(Golden, KeepsHeightsAndTraceToWithinHalfAQuantum) {
  write_golden(folder / "golden/dune", finished());
  const GoldenContent content = read_golden(entry());
  EXPECT_LE((content.change - (run.final - run.initial)).abs().maxCoeff(), 0x1p-31);
  const Hdf5Reader file(folder / "golden/dune/golden.h5");
  EXPECT_EQ(file.shape("/surface/change"), (std::vector<hsize_t>{6, 10})) << "only the cells that changed";
  ASSERT_TRUE(content.trace);
  const std::vector<TickRecord>& rows = content.trace->rows;
  ASSERT_EQ(rows.size(), SyntheticRun::ticks) << "every tick";
  EXPECT_TRUE(std::isnan(rows[1].level)) << "lifted";
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const TickRecord& tick = run.trace[k];
    EXPECT_EQ(rows[k].time, tick.time);
    EXPECT_EQ(rows[k].contact, tick.contact);
    EXPECT_NEAR(rows[k].device_force.z(), tick.device_force.z(), 0x1p-18);
    EXPECT_NEAR(rows[k].depth, tick.depth, 0x1p-28);
  }
}

TEST_F(Golden, KeepsEachFieldOfATickInItsPlace) {
  for (std::size_t k = 0; k < run.trace.size(); ++k) {
    const double number = 8.0 * static_cast<double>(k);
    TickRecord& tick = run.trace[k];
    tick.device_force = {number + 1.0, number + 2.0, number + 3.0};
    tick.depth = number + 4.0;
    tick.level = number + 5.0;
    tick.contact = k % 20 == 0;
  }
  write_golden(folder / "golden/dune", finished());
  const std::vector<TickRecord> rows = read_golden(entry()).trace->rows;
  ASSERT_EQ(rows.size(), run.trace.size());
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const TickRecord& tick = run.trace[k];
    EXPECT_EQ(rows[k].time, tick.time);
    EXPECT_EQ(rows[k].device_force, tick.device_force);
    EXPECT_EQ(rows[k].depth, tick.depth);
    EXPECT_EQ(rows[k].level, tick.level);
    EXPECT_EQ(rows[k].contact, tick.contact);
  }
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

TEST_F(Golden, TimesOfTicksWithGapsAreKeptToTheBit) {
  run.scene = "[device]\nservo_rate = 3333.3\n";
  std::int64_t number = 0;
  for (std::size_t k = 0; k < run.trace.size(); ++k, number += k % 30 == 0 ? 1'000'000'007 : 1)
    run.trace[k].time = static_cast<double>(number) / 3333.3;
  write_golden(folder / "golden/dune", finished());
  const std::vector<TickRecord> rows = read_golden(entry()).trace->rows;
  ASSERT_EQ(rows.size(), run.trace.size());
  for (std::size_t k = 0; k < rows.size(); ++k) EXPECT_EQ(rows[k].time, run.trace[k].time);
}

TEST_F(Golden, ATraceThatItCannotKeepIsRefused) {
  using Change = std::function<void(TickRecord&)>;
  for (const auto& [words, change] : std::vector<std::pair<std::string, Change>>{
           {"at time 0.05 s is not finite", [](TickRecord& tick) { tick.device_force.y() = std::nan(""); }},
           {"at time 0.05 s is not finite", [](TickRecord& tick) { tick.depth = -HUGE_VAL; }},
           {"at time 0.05 s is not finite", [](TickRecord& tick) { tick.level = std::nan(""); }},
           {"at time 0.05 s is not finite or too large", [](TickRecord& tick) { tick.level = 1e9; }},
           {"time 0.0504 s is no whole multiple", [](TickRecord& tick) { tick.time = 0.0504; }}}) {
    run = SyntheticRun();
    change(run.trace[50]);
    try {
      write_golden(folder / "golden/dune", finished());
      ADD_FAILURE() << words;
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
    }
  }
}

TEST_F(Golden, AnEntryOfAnotherFormatSaysWhatToDo) {
  write_golden(folder / "golden/dune", finished());
  for (const auto& [version, words] :
       {std::pair{
            1.0,
            "has format 1, and this program reads format 2; make it anew: sandstroke golden update dune"},
        {3.0, "has format 3, and this program reads format 2; use a newer version"}}) {
    Hdf5Writer file(folder / "golden/dune/golden.h5", output_kind(InputKind::golden));
    file.attribute("/", "format_version", version);
    file.finish();
    EXPECT_NE(check_table(compare()).find(words), std::string::npos) << check_table(compare());
  }
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

TEST_F(Golden, KeepsTheSmallestChange) {
  run.final(2, 3) = 2e-9;
  write_golden(folder / "golden/dune", finished());
  EXPECT_NEAR(read_golden(entry()).change(2, 3), 2e-9, 0x1p-31);
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
                      "if that is wanted: sandstroke golden update dune");
}

TEST_F(Golden, AChangedStrokeNamesItsFile) {
  run.scene += "[stroke]\nfile = \"hand.h5\"\n";
  write_golden(folder / "golden/dune", finished());
  run.stroke_hash = "";
  expect_only_failure(
      "stroke", "changed: hand.h5 holds another stroke; if that is wanted: sandstroke golden update dune");
}

TEST_F(Golden, WhatPassesDoesNotSayThatItFailed) {
  write_golden(folder / "golden/dune", finished());
  run.final(12, 25) += 5e-7;
  GoldenRun ran = finished();
  ran.result.volume_drift = 3e-17;
  const Comparison comparison = compare_golden(entry(), ran, Tolerances{});
  for (const Check& check : comparison.checks)
    for (const char* word : {"changed", "no step", "must", "golden update"})
      EXPECT_EQ(check.sentence.find(word), std::string::npos) << check.name << ": " << check.sentence;
  for (const Check& check : comparison.checks)
    if (check.measured == 0.0 && check.name != "cell size") {
      EXPECT_EQ(check.sentence.find("differs"), std::string::npos) << check.name << ": " << check.sentence;
    }
  ran.result.volume_drift = 3e-9;
  sandstroke::expect_only_failure(compare_golden(entry(), ran, Tolerances{}), "volume drift",
                                  "no step may do that");
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

TEST_F(Golden, ADamagedEntryIsNotBelieved) {
  write_golden(folder / "golden/dune", finished());
  const HeightGrid one = HeightGrid::Zero(1, 1), none = HeightGrid::Zero(0, 0);
  constexpr double nan = std::numeric_limits<double>::quiet_NaN(), infinite = HUGE_VAL;
  claim(30, 40, 0.01, 1, one);
  EXPECT_NO_THROW(read_golden(entry()));
  for (const double side : {0.0, -1.0, 65537.0, nan}) {
    claim(side, 40, 0.01, 1, none);
    expect_only_failure("golden content", "does not lie in the bed");
    claim(30, side, 0.01, 1, none);
    expect_only_failure("golden content", "does not lie in the bed");
  }
  for (const double cell_size : {0.0, -0.01, nan, infinite}) {
    claim(30, 40, cell_size, 1, one);
    expect_only_failure("golden content", "cell_size");
  }
  for (const double servo_rate : {-1.0, 0.0, nan, infinite}) {
    claim(30, 40, 0.01, servo_rate, one);
    expect_only_failure("golden content", "servo_rate");
  }
}

TEST_F(Golden, ASmallEntryOfAHugeBedIsRefusedBeforeItTakesMemory) {
  constexpr double side = BedGeometry::most_cells;
  if (memory_room().bytes > 4.0 * sizeof(double) * side * side) GTEST_SKIP() << "there is room for it";
  write_golden(folder / "golden/dune", finished());
  claim(side, side, 0.01, 1, HeightGrid::Zero(1, 1));
  EXPECT_THROW(read_golden(entry()), NotEnoughMemory);
  EXPECT_THROW(compare(), NotEnoughMemory) << "that says nothing about the run";
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

// --- folders of scenes ---

class GoldenScenes : public Golden {
 protected:
  GoldenScenes() : folders{folder / "strokes", folder / "golden"} {
    for (const char* name : {"dune", "letters"}) {
      fs::create_directories(folders.strokes / name);
      std::ofstream(folders.scene(name)) << "";
    }
  }
  SceneRunner runner() {
    return [this](const fs::path& scene, const fs::path& run_file) {
      ran.push_back(scene.parent_path().filename());
      run.write(run_file);
      return GoldenRun{run_file, picture, {}};
    };
  }
  Comparison check(const std::string& name, const GivenTolerances& options = {}) {
    return check_golden(name, folders, runner(), options, folder / "report");
  }

  GoldenFolders folders;
  std::vector<std::string> ran;
};

TEST_F(GoldenScenes, UpdatedSceneChecksAndReports) {
  update_golden("dune", folders, runner());
  EXPECT_TRUE(check("dune").passed());
  EXPECT_EQ(ran, (std::vector<std::string>{"dune", "dune"}));
  EXPECT_NE(read_text_file(folder / "report/dune.html").find("dune against its golden entry"),
            std::string::npos);
}

TEST_F(GoldenScenes, TheEntrysOwnTolerancesCountAndOptionsBeforeThem) {
  update_golden("dune", folders, runner());
  update_golden("letters", folders, runner());
  run.trace[47].device_force.x() += 0.005;
  EXPECT_FALSE(check("dune").passed());
  const fs::path file = folders.entry("dune").folder / "tolerances.toml";
  put_text(file, "force = 0.006   # N\npixel = 3\n");
  const Comparison own = check("dune");
  EXPECT_TRUE(own.passed()) << check_table(own);
  EXPECT_EQ(changed_tolerances(own.tolerances),
            fmt::format("force 0.006 N ({0}), pixel 3 of 255 ({0})", file.string()));
  EXPECT_FALSE(check("letters").passed()) << "which has no such file";
  const Comparison stricter = check("dune", {{"force", 0.004}});
  EXPECT_EQ(stricter.failures(), 1);
  EXPECT_EQ(changed_tolerances(stricter.tolerances),
            fmt::format("force 0.004 N (--force-tolerance), pixel 3 of 255 ({})", file.string()));
  EXPECT_TRUE(check("letters", {{"force", 0.006}}).passed());
  run = SyntheticRun();
  update_golden("dune", folders, runner());
  EXPECT_EQ(read_text_file(file), "force = 0.006   # N\npixel = 3\n") << "an update leaves it";
}

TEST_F(GoldenScenes, ToleranceFilesWithWrongNumbersFailWithoutARun) {
  update_golden("dune", folders, runner());
  ran.clear();
  for (const auto& [text, words] :
       {std::pair("force = 1e-6\n", "tolerances.toml:1: force is 1e-06; give a number 1e-05 or more"),
        {"\nforse = 1\n", "tolerances.toml:2: unknown key forse"},
        {"pixel = 1.5\n", "tolerances.toml:1: pixel is 1.5; give a whole number"},
        {"pixel_share = 2\n", "tolerances.toml:1: pixel_share is 2; give a number from 0 to 1"}}) {
    put_text(folders.entry("dune").folder / "tolerances.toml", text);
    sandstroke::expect_only_failure(check("dune"), "tolerances", words);
  }
  EXPECT_TRUE(ran.empty());
}

TEST_F(GoldenScenes, CommandsThatAreSuggestedNameTheFolders) {
  EXPECT_EQ(GoldenFolders().entry("dune").update, "sandstroke golden update dune");
  EXPECT_EQ((GoldenFolders{"strokes", "my golden"}.entry("dune").update),
            "sandstroke golden update dune --golden 'my golden'");
  EXPECT_EQ((GoldenFolders{"in/scenes", "golden"}.entry("a b").update),
            "sandstroke golden update 'a b' --strokes in/scenes");
  const std::string update = folders.entry("dune").update;
  EXPECT_NE(check("dune").checks[0].sentence.find(update), std::string::npos) << "no entry";
  update_golden("dune", folders, runner());
  run.initial(3, 3) = run.final(3, 3) = 0.01;
  EXPECT_NE(check_table(check("dune")).find(update), std::string::npos) << "another surface";
  fs::remove(folders.entry("dune").folder / "golden.h5");
  EXPECT_NE(check_table(check("dune")).find(update), std::string::npos) << "no golden.h5";
}

TEST_F(GoldenScenes, NamesAreTheUnionOfScenesAndEntries) {
  fs::create_directories(folders.entry("old").folder);
  fs::create_directories(folders.entry("dune.part").folder);  // an update that was killed
  fs::create_directories(folders.strokes / "no-scene");
  EXPECT_EQ(golden_names(folders, {}), (std::vector<std::string>{"dune", "letters", "old"}));
  EXPECT_EQ(golden_names(folders, {"letters"}), (std::vector<std::string>{"letters"}));
  try {
    golden_names(folders, {"dunes"});
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.exit_code(), 2);
    EXPECT_NE(std::string(error.what()).find("dune, letters"), std::string::npos) << error.what();
  }
}

TEST_F(GoldenScenes, NothingAtAllIsNoSuccess) {
  fs::create_directories(folder / "empty");
  EXPECT_THROW(golden_names({folder / "empty", folder / "empty"}, {}), Error);
  EXPECT_THROW(golden_names({folder / "missing", folders.golden}, {}), Error);
}

TEST_F(GoldenScenes, MissingEntryAndMissingSceneFailWithoutARun) {
  EXPECT_EQ(check("letters").failures(), 1);
  EXPECT_EQ(check("letters").checks[0].name, "golden entry");
  fs::create_directories(folders.entry("old").folder);
  EXPECT_EQ(check("old").checks[0].name, "scene");
  EXPECT_FALSE(check("old").passed());
  EXPECT_TRUE(ran.empty());
}

TEST_F(GoldenScenes, ARunThatStopsIsAFailedCheck) {
  update_golden("dune", folders, runner());
  const SceneRunner stops = [](const fs::path&, const fs::path&) -> GoldenRun {
    throw_input_error("scene.toml:3: no");
  };
  const Comparison comparison = check_golden("dune", folders, stops, {}, "");
  EXPECT_EQ(comparison.checks.at(0).sentence, "scene.toml:3: no");
  EXPECT_FALSE(comparison.passed());
  EXPECT_THROW(update_golden("dune", folders, stops), Error);
  EXPECT_TRUE(check("dune").passed()) << "a failed update changes nothing";
}

TEST_F(GoldenScenes, AnInterruptedRunIsNoSuccessAndChangesNothing) {
  update_golden("dune", folders, runner());
  const SceneRunner interrupted = [](const fs::path&, const fs::path&) {
    GoldenRun unfinished;
    unfinished.result.interrupted = true;
    return unfinished;
  };
  EXPECT_FALSE(check_golden("dune", folders, interrupted, {}, "").passed());
  EXPECT_FALSE(update_golden("dune", folders, interrupted));
  EXPECT_TRUE(check("dune").passed());
}

TEST_F(GoldenScenes, ADamagedEntryFailsEvenWithAReport) {
  update_golden("dune", folders, runner());
  std::ofstream(folders.entry("dune").folder / "golden.h5") << "rubbish";
  EXPECT_EQ(check("dune").failures(), 1);
}

TEST_F(GoldenScenes, UpdateOfAnUnknownSceneIsBadInput) {
  EXPECT_THROW(update_golden("dunes", folders, runner()), Error);
  // One that is there, by a path that leads out of both folders and in again.
  for (const char* name : {"../strokes/dune", "./dune", "dune/", "..", ".", ""})
    EXPECT_THROW(update_golden(name, folders, runner()), Error) << name;
}

}  // namespace
}  // namespace sandstroke
