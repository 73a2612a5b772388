#include <gtest/gtest.h>
#include <spdlog/fmt/fmt.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>

#include "cli/program.h"
#include "hdf5/hdf5_file.h"
#include "io/run_file.h"
#include "real_client.h"

namespace sandstroke {
namespace {

namespace fs = std::filesystem;

/// A folder with strokes/tiny and its golden entry.
fs::path folder_with_golden_entry() {
  const fs::path folder = test_folder();
  fs::create_directories(folder / "strokes/tiny");
  fs::rename(folder / "scene.toml", folder / "strokes/tiny/scene.toml");
  fs::rename(folder / "line.toml", folder / "strokes/tiny/line.toml");
  const ProgramResult update = run_program({"golden", "update", "tiny"}, folder);
  EXPECT_EQ(update.exit_code, 0) << update.err;
  return folder;
}

TEST(CliGolden, CheckPassesAfterUpdateAndSaysWhatItIsMadeFrom) {
  const fs::path folder = folder_with_golden_entry();
  const ProgramResult check = run_program({"golden", "check"}, folder);
  EXPECT_EQ(check.exit_code, 0) << check.out << check.err;
  const std::string provenance = read_file(folder / "golden/tiny/provenance.toml");
  for (const char* part : {"version", "compiler", "scene_hash", "stroke_hash"})
    EXPECT_NE(provenance.find(part), std::string::npos) << part;
}

TEST(CliGolden, AChangedStrokeOrSceneFails) {
  const fs::path folder = folder_with_golden_entry();
  const std::string scene = read_file(folder / "strokes/tiny/scene.toml"),
                    stroke = read_file(folder / "strokes/tiny/line.toml");
  write_file(folder / "strokes/tiny/scene.toml", scene + "[relaxation]\ntalus_angle = 30.1\n");
  const ProgramResult changed = run_program({"golden", "check", "--junit", "golden.xml"}, folder);
  EXPECT_EQ(changed.exit_code, 1);
  EXPECT_NE(changed.out.find("golden update tiny"), std::string::npos) << changed.out;
  EXPECT_NE(read_file(folder / "golden.xml").find("<failure"), std::string::npos);

  write_file(folder / "strokes/tiny/scene.toml", scene);
  write_file(folder / "strokes/tiny/line.toml", stroke + "speed = 0.21\n");
  EXPECT_EQ(run_program({"golden", "check"}, folder).exit_code, 1);
}

TEST(CliGolden, TakesSandThatDoesNotRestOnlyWhenAsked) {
  const fs::path folder = folder_with_golden_entry();
  const std::string scene = read_file(folder / "strokes/tiny/scene.toml"),
                    entry = read_file(folder / "golden/tiny/golden.h5");
  write_file(folder / "strokes/tiny/scene.toml", scene + "[relaxation]\nmax_passes = 0\n");
  const ProgramResult refused = run_program({"golden", "update", "tiny"}, folder);
  EXPECT_EQ(refused.exit_code, 3);
  EXPECT_NE(refused.err.find("add --doubtful"), std::string::npos) << refused.err;
  EXPECT_EQ(read_file(folder / "golden/tiny/golden.h5"), entry);
  EXPECT_EQ(run_program({"golden", "update", "--doubtful", "tiny"}, folder).exit_code, 0);
  EXPECT_NE(read_file(folder / "golden/tiny/golden.h5"), entry);
  EXPECT_EQ(run_program({"golden", "check"}, folder).exit_code, 0);
}

TEST(CliGolden, NoSceneTakesThePageOfAllScenes) {
  const fs::path folder = folder_with_golden_entry();
  fs::rename(folder / "strokes/tiny", folder / "strokes/index");
  fs::rename(folder / "golden/tiny", folder / "golden/index");
  EXPECT_EQ(run_program({"golden", "check"}, folder).exit_code, 0);
  const ProgramResult refused = run_program({"golden", "check", "--report", "pages"}, folder);
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_NE(refused.err.find("a scene is called \"index\""), std::string::npos) << refused.err;
}

TEST(CliGolden, HeightsAndForcesAreJudgedNotOnlyNames) {
  const fs::path folder = folder_with_golden_entry();
  const std::string stroke = read_file(folder / "strokes/tiny/line.toml");
  write_file(folder / "strokes/tiny/line.toml", stroke.substr(0, stroke.find("0.004")) + "0.00401\n");
  const ProgramResult check = run_program({"golden", "check", "--json"}, folder);
  EXPECT_EQ(check.exit_code, 1);
  std::set<std::string> failed;
  const nlohmann::json report = nlohmann::json::parse(check.out);
  for (const auto& one : report["scenes"][0]["checks"])
    if (!one["passed"]) failed.insert(one["name"]);
  EXPECT_TRUE(failed.contains("height change")) << check.out;
  EXPECT_TRUE(failed.contains("force")) << check.out;
}

/// A straight stroke at 1 kHz, of which one sample may be moved.
void write_stroke(const fs::path& folder, double spike) {
  std::string table = "x,y,z\n";
  for (int k = 0; k <= 400; ++k)
    table += fmt::format("{},{},{}\n", -0.04 + 2e-4 * k, 0.0, -0.004 - (k == 203 ? spike : 0.0));
  write_file(folder / "hand.csv", table);
  const ProgramResult made =
      run_program({"stroke", "convert", "hand.csv", "strokes/tiny/hand.h5", "--rate", "1000", "--position",
                   "x,y,z", "--position-unit", "m", "--overwrite"},
                  folder);
  ASSERT_EQ(made.exit_code, 0) << made.err;
}

/// The difference of two runs (--json) in the force.
double force_difference(const nlohmann::json& comparison) {
  for (const auto& check : comparison["checks"])
    if (check["name"] == "force") return check["measured"];
  return -1.0;
}

TEST(CliGolden, OneSampleOfAStrokeThatIsMovedIsSeenWithItsWholeForce) {
  const fs::path folder = folder_with_golden_entry();
  const std::string scene = read_file(folder / "strokes/tiny/scene.toml");
  write_file(folder / "strokes/tiny/scene.toml",
             std::regex_replace(scene, std::regex("line.toml"), "hand.h5"));
  write_stroke(folder, 0.0);
  ASSERT_EQ(run_program({"golden", "update", "tiny"}, folder).exit_code, 0);
  ASSERT_EQ(run_program({"run", "strokes/tiny/scene.toml", "-o", "before.h5"}, folder).exit_code, 0);
  write_stroke(folder, 0.02);
  ASSERT_EQ(run_program({"run", "strokes/tiny/scene.toml", "-o", "after.h5"}, folder).exit_code, 0);
  const ProgramResult check = run_program({"golden", "check", "--json"}, folder);
  EXPECT_EQ(check.exit_code, 1);
  const double spike = force_difference(
      nlohmann::json::parse(run_program({"compare", "before.h5", "after.h5", "--json"}, folder).out));
  EXPECT_GT(spike, 5.0);
  EXPECT_NEAR(force_difference(nlohmann::json::parse(check.out)["scenes"][0]), spike, 2e-5) << check.out;
}

TEST(CliGolden, APythonReaderOfJUnitReadsTheReportWithItsTimes) {
  SANDSTROKE_NEEDS(python_has("junitparser"), "python3-junitparser");
  const fs::path folder = folder_with_golden_entry();
  write_file(folder / "strokes/tiny/scene.toml",
             read_file(folder / "strokes/tiny/scene.toml") + "[relaxation]\ntalus_angle = 31.0\n");
  ASSERT_EQ(run_program({"golden", "check", "--junit", "golden.xml"}, folder).exit_code, 1);
  write_file(folder / "read.py",
             "import junitparser, sys\n"
             "suite, = junitparser.JUnitXml.fromfile(sys.argv[1])\n"
             "run, = [case for case in suite if case.name == 'run complete']\n"
             "scene, = [case for case in suite if case.name == 'scene']\n"
             "assert suite.name == 'tiny' and suite.tests == len(list(suite)) and suite.failures > 0\n"
             "assert 0 < run.time <= suite.time\n"
             "assert abs(sum(case.time for case in suite) - suite.time) < 0.02\n"
             "assert run.is_passed and 'talus_angle was 30, is 31' in scene.result[0].message\n");
  const auto read = run_child({python, (folder / "read.py").string(), (folder / "golden.xml").string()});
  EXPECT_TRUE(read && read->exit_code == 0) << (read ? read->err : "");
}

TEST(CliGolden, TolerancesOfTheEntryAndOfTheCommandLineAreUsedAndSaid) {
  const fs::path folder = folder_with_golden_entry();
  const std::string scene = read_file(folder / "strokes/tiny/scene.toml");
  write_file(folder / "strokes/tiny/scene.toml", scene + "[force]\nk_f = 10.001\n");  // 1e-4 of the drag
  const auto failed = [&](const std::vector<std::string>& options) {
    std::vector<std::string> words = {"golden", "check", "--json"};
    words.insert(words.end(), options.begin(), options.end());
    std::set<std::string> names;
    const nlohmann::json report = nlohmann::json::parse(run_program(words, folder).out);
    for (const auto& one : report["scenes"][0]["checks"])
      if (!one["passed"]) names.insert(one["name"]);
    return names;
  };
  const std::set<std::string> only_scene{"scene"}, force_too{"force", "scene"};
  EXPECT_EQ(failed({"--force-tolerance", "1e-5"}), force_too);
  EXPECT_EQ(failed({"--force-tolerance", "1"}), only_scene);
  write_file(folder / "golden/tiny/tolerances.toml", "force = 1e-5\n");
  EXPECT_EQ(failed({}), force_too);
  EXPECT_EQ(failed({"--force-tolerance", "1"}), only_scene);
  const ProgramResult said = run_program({"golden", "check", "--report", "pages"}, folder);
  EXPECT_NE(said.out.find("tolerances: force 1e-05 N (golden/tiny/tolerances.toml)\n"), std::string::npos)
      << said.out;
  EXPECT_NE(read_file(folder / "pages/tiny.html").find("golden/tiny/tolerances.toml"), std::string::npos);
  const ProgramResult refused = run_program({"golden", "check", "--force-tolerance", "1e-7"}, folder);
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_NE(refused.err.find("1e-7 is not a number 1e-05 or more"), std::string::npos) << refused.err;
}

TEST(CliGolden, TheReportIsAnIndexAndAPageOfEachSceneThatDiffers) {
  const fs::path folder = folder_with_golden_entry();
  fs::copy(folder / "strokes/tiny", folder / "strokes/another");
  ASSERT_EQ(run_program({"golden", "update", "another"}, folder).exit_code, 0);
  const std::string stroke = read_file(folder / "strokes/tiny/line.toml");
  write_file(folder / "strokes/tiny/line.toml", stroke + "speed = 0.21\n");
  const ProgramResult check = run_program({"golden", "check", "--report", "pages"}, folder);
  EXPECT_EQ(check.exit_code, 1);
  EXPECT_NE(check.out.find("pages/index.html"), std::string::npos) << check.out;
  EXPECT_TRUE(fs::exists(folder / "pages/tiny.html"));
  EXPECT_FALSE(fs::exists(folder / "pages/another.html"));
  const std::string index = read_file(folder / "pages/index.html");
  const auto at = [&](const char* name) { return index.find("\"name\":\"" + std::string(name) + "\""); };
  EXPECT_LT(at("tiny"), at("another")) << "the worst first";
  ASSERT_EQ(run_program({"golden", "check", "another", "--report", "all", "--all-pages"}, folder).exit_code,
            0);
  EXPECT_TRUE(fs::exists(folder / "all/another.html"));
}

TEST(CliCompare, NamesTheSettingsThatDiffer) {
  const fs::path folder = test_folder();
  for (const auto& [output, angle] :
       {std::pair("a.h5", "relaxation.talus_angle=30"), {"b.h5", "relaxation.talus_angle=31"}})
    ASSERT_EQ(run_program({"run", "scene.toml", "-o", output, "--set", angle}, folder).exit_code, 0);
  const ProgramResult compared = run_program({"compare", "a.h5", "b.h5"}, folder);
  EXPECT_NE(compared.out.find("settings that differ: relaxation.talus_angle was 30, is 31\n"),
            std::string::npos)
      << compared.out;
  const auto json = nlohmann::json::parse(run_program({"compare", "a.h5", "b.h5", "--json"}, folder).out);
  EXPECT_EQ(json["settings"], "relaxation.talus_angle was 30, is 31");
  EXPECT_EQ(run_program({"compare", "a.h5", "a.h5"}, folder).out.find("settings"), std::string::npos);
}

TEST(CliGolden, AMissingEntryAndAMissingSceneFail) {
  const fs::path folder = folder_with_golden_entry();
  fs::rename(folder / "golden/tiny", folder / "golden/other");
  const ProgramResult check = run_program({"golden", "check"}, folder);
  EXPECT_EQ(check.exit_code, 1);
  EXPECT_NE(check.out.find("tiny"), std::string::npos);
  EXPECT_NE(check.out.find("other"), std::string::npos);
}

/// run.h5, and changed.h5: the same but for what `change` does to one dataset.
void write_changed_copy(const fs::path& folder, const std::string& dataset, std::size_t entry,
                        double change) {
  fs::copy_file(folder / "run.h5", folder / "changed.h5", fs::copy_options::overwrite_existing);
  const Hdf5Handle file(H5Fopen((folder / "changed.h5").c_str(), H5F_ACC_RDWR, without_locks()), H5Fclose);
  const Hdf5Handle data(H5Dopen2(file, dataset.c_str(), H5P_DEFAULT), H5Dclose);
  const Hdf5Handle space(H5Dget_space(data), H5Sclose);
  std::vector<double> values(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)));
  H5Dread(data, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
  values[entry] += change;
  H5Dwrite(data, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
}

TEST(CliCompare, PassesForItselfAndFailsForOneCellOrOneForceSample) {
  const fs::path folder = test_folder();
  ASSERT_EQ(run_program({"run", "scene.toml", "-o", "run.h5"}, folder).exit_code, 0);
  EXPECT_EQ(run_program({"compare", "run.h5", "run.h5"}, folder).exit_code, 0);

  write_changed_copy(folder, "/surface/final", 50 * 150 + 70, 2e-6);
  const ProgramResult cell = run_program({"compare", "run.h5", "changed.h5", "--json"}, folder);
  EXPECT_EQ(cell.exit_code, 1);
  EXPECT_FALSE(nlohmann::json::parse(cell.out)["passed"]);
  EXPECT_EQ(run_program({"compare", "run.h5", "changed.h5", "--height-tolerance", "3e-6"}, folder).exit_code,
            0);

  write_changed_copy(folder, "/trace/device_force", 3 * 400 + 2, 0.01);
  const ProgramResult force =
      run_program({"compare", "run.h5", "changed.h5", "--report", "report", "--junit", "j.xml"}, folder);
  EXPECT_EQ(force.exit_code, 1);
  EXPECT_NE(force.out.find("FAILED"), std::string::npos);
  EXPECT_TRUE(fs::exists(folder / "j.xml"));
  EXPECT_NE(force.out.find("report/compare.html"), std::string::npos);
  EXPECT_TRUE(fs::exists(folder / "report/compare.html"));
}

TEST(CliCompare, RunsOnOtherCellsAreComparedInMeans) {
  const fs::path folder = test_folder();
  ASSERT_EQ(run_program({"run", "scene.toml", "-o", "coarse.h5"}, folder).exit_code, 0);
  ASSERT_EQ(
      run_program({"run", "scene.toml", "-o", "fine.h5", "--set", "bed.cells=[300, 200]"}, folder).exit_code,
      0);
  const ProgramResult refused = run_program({"compare", "coarse.h5", "fine.h5"}, folder);
  EXPECT_EQ(refused.exit_code, 1);
  EXPECT_NE(refused.out.find("--coarsen compares means of 2 x 2 cells of the run"), std::string::npos)
      << refused.out;
  const HeightGrid coarse = RunFile(folder / "coarse.h5").final(), fine = RunFile(folder / "fine.h5").final();
  double largest = 0.0;
  for (Eigen::Index row = 0; row < coarse.rows(); ++row)
    for (Eigen::Index col = 0; col < coarse.cols(); ++col)
      largest = std::max(largest, std::abs(fine.block(2 * row, 2 * col, 2, 2).mean() - coarse(row, col)));
  ASSERT_GT(largest, 1e-5);
  const ProgramResult compared =
      run_program({"compare", "coarse.h5", "fine.h5", "--coarsen", "--json", "--report", "page"}, folder);
  const nlohmann::json report = nlohmann::json::parse(compared.out);
  for (const auto& check : report["checks"])
    if (check["name"] == "final height") {
      EXPECT_NEAR(check["measured"].get<double>(), largest, 1e-15);
    }
  const std::vector<std::string> loose = {
      "compare", "coarse.h5",         "fine.h5", "--coarsen",         "--height-tolerance",
      "1",       "--force-tolerance", "100",     "--depth-tolerance", "1"};
  const ProgramResult same = run_program(loose, folder);
  EXPECT_EQ(same.exit_code, 0) << same.out;
  EXPECT_TRUE(
      same.out.ends_with("\ncell size: coarsened to cells of 0.002 m: means of 2 x 2 cells of the run are "
                         "compared\nsame within the tolerances\n"))
      << same.out;
}

TEST(CliCompare, EndsWithItsVerdict) {
  const fs::path folder = test_folder();
  ASSERT_EQ(run_program({"run", "scene.toml", "-o", "run.h5"}, folder).exit_code, 0);
  write_changed_copy(folder, "/trace/device_force", 3 * 400 + 2, 0.01);
  EXPECT_TRUE(
      run_program({"compare", "run.h5", "run.h5"}, folder).out.ends_with("\nsame within the tolerances\n"));
  EXPECT_TRUE(run_program({"compare", "run.h5", "changed.h5", "--report", "page"}, folder)
                  .out.ends_with("\ndiffers: force\n"));
  write_file(folder / "picture.png", "");
  EXPECT_NE(run_program({"compare", "picture.png", "picture.png", "--coarsen"}, folder)
                .err.find("--coarsen: picture.png is a picture"),
            std::string::npos);
}

TEST(CliGolden, AMissingStrokeIsAFindingOfItsSceneAndTheOthersGoOn) {
  const fs::path folder = folder_with_golden_entry();
  fs::copy(folder / "strokes/tiny", folder / "strokes/another");
  ASSERT_EQ(run_program({"golden", "update", "another"}, folder).exit_code, 0);
  fs::remove(folder / "strokes/another/line.toml");
  const ProgramResult check =
      run_program({"golden", "check", "--report", "pages", "--junit", "pages/golden.xml"}, folder);
  EXPECT_EQ(check.exit_code, 1) << check.err;
  EXPECT_NE(check.out.find("FAILED  another\n        scene: strokes/another/line.toml does not exist"),
            std::string::npos)
      << check.out;
  EXPECT_NE(check.out.find("ok      tiny"), std::string::npos) << check.out;
  EXPECT_TRUE(fs::exists(folder / "pages/golden.xml"));
}

TEST(CliCompare, WhatIsNoNumberFailsWhereverItIs) {
  const fs::path folder = test_folder();
  ASSERT_EQ(run_program({"run", "scene.toml", "-o", "run.h5", "--frames", "5"}, folder).exit_code, 0);
  for (const auto& [dataset, sentence] :
       {std::pair("/surface/frame/000003/changed",
                  "/surface/frame/000003/changed has heights that are not numbers"),
        {"/trace/device_position", "finite positions: the run: not a number at time 0.03 s"},
        {"/trace/hand_position", "finite positions: the run: not a number at time 0.03 s"}}) {
    write_changed_copy(folder, dataset, 3 * 30 + 1, std::nan(""));
    const ProgramResult compared = run_program({"compare", "run.h5", "changed.h5"}, folder);
    EXPECT_EQ(compared.exit_code, 1) << dataset;
    EXPECT_NE(compared.out.find(sentence), std::string::npos) << compared.out;
  }
  EXPECT_EQ(run_program({"compare", "run.h5", "run.h5"}, folder).exit_code, 0);
}

TEST(CliCompare, ADifferentShapeIsAFailure) {
  const fs::path folder = test_folder();
  ASSERT_EQ(run_program({"run", "scene.toml", "-o", "a.h5"}, folder).exit_code, 0);
  ASSERT_EQ(run_program({"run", "scene.toml", "-o", "b.h5", "--set", "bed.size=[0.3, 0.3]", "--set",
                         "bed.cells=[150, 150]"},
                        folder)
                .exit_code,
            0);
  EXPECT_EQ(run_program({"compare", "a.h5", "b.h5"}, folder).exit_code, 1);
}

}  // namespace
}  // namespace sandstroke
