// The pages that bench, stress, compare and golden leave, from quick runs of the program, in headless
// Chromium.
#include <gtest/gtest.h>

#include <csignal>
#include <nlohmann/json.hpp>

#include "browser.h"
#include "cli/program.h"
#include "sanitized.h"

namespace sandstroke {
namespace {

namespace fs = std::filesystem;

class CliPages : public BrowserTest {
 protected:
  /// The page is drawn, without errors: its number of charts and the titles of its sections.
  static nlohmann::json drawn_page(const fs::path& page) {
    const OpenedPage opened =
        open_page(read_file(page),
                  "[" + page_state + ", [...document.querySelectorAll('h2')].map((h) => h.textContent)]");
    EXPECT_TRUE(opened.console.empty()) << opened.console.front();
    EXPECT_EQ(opened.answer[0][0], "true");
    EXPECT_EQ(opened.answer[0][2], 0);
    return {opened.answer[0][1], opened.answer[1]};
  }
};

TEST_F(CliPages, BenchDrawsEveryProblem) {
  const fs::path folder = test_folder();
  const ProgramResult run =
      run_program({"bench", "--quick", "--repeats", "1", "-o", "out", "--json"}, folder);
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const nlohmann::json data = nlohmann::json::parse(run.out);
  EXPECT_GE(data["problems"].size(), 11u);
  const OpenedPage page = open_page(read_file(folder / "out/bench.html"), page_state);
  EXPECT_TRUE(page.console.empty()) << page.console.front();
  EXPECT_EQ(page.answer[0], "true");
  EXPECT_EQ(page.answer[2], 0);
  EXPECT_GE(page.answer[1], data["problems"].size());  // each has a chart of run time against error
}

TEST_F(CliPages, StressDrawsEveryMapAndNothingSurprises) {
  const fs::path folder = test_folder();
  const ProgramResult run = run_program({"stress", "--quick", "-o", "out", "--json"}, folder);
  ASSERT_EQ(run.exit_code, 0) << run.err << run.out.substr(0, 300);
  const nlohmann::json data = nlohmann::json::parse(run.out);
  EXPECT_EQ(data["surprises"], 0);
  EXPECT_GE(data["boundaries"].size(), 50u);
  const OpenedPage page = open_page(read_file(folder / "out/stress.html"), page_state);
  EXPECT_TRUE(page.console.empty()) << page.console.front();
  EXPECT_EQ(page.answer[0], "true");
  EXPECT_EQ(page.answer[2], 0);
  EXPECT_GE(page.answer[1], data["maps"].size() + data["traces"].size());
}

TEST_F(CliPages, StressOfASceneSaysHowFarItIsFromItsBoundaries) {
  const fs::path folder = test_folder();
  const ProgramResult run = run_program({"stress", "--scene", "scene.toml", "--quick", "-o", "out"}, folder);
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_NE(run.out.find("stiffness of the sand"), std::string::npos) << run.out;
  const OpenedPage page =
      open_page(read_file(folder / "out/stress.html"),
                "[" + page_state + ", document.querySelector('#margins li').textContent]");
  EXPECT_EQ(page.answer[0], nlohmann::ordered_json({"true", 4, 0}));
  EXPECT_NE(page.answer[1].get<std::string>().find("this scene: stable"), std::string::npos)
      << page.answer[1];
  // Late by 200 ticks it is not.
  write_file(folder / "scene.toml", read_file(folder / "scene.toml") + "[force]\nk_s = 1e5\n");
  const ProgramResult stiff =
      run_program({"stress", "--scene", "scene.toml", "--quick", "-o", "out"}, folder);
  EXPECT_EQ(stiff.exit_code, 3) << stiff.err;
  EXPECT_NE(stiff.out.find("UNSTABLE"), std::string::npos) << stiff.out;
}

TEST_F(CliPages, CompareDrawsTwoRunsAndTwoPictures) {
  const fs::path folder = test_folder();
  ASSERT_EQ(run_program({"run", "scene.toml", "-o", "a.h5", "--png", "a.png"}, folder).exit_code, 0);
  ASSERT_EQ(
      run_program({"run", "scene.toml", "-o", "b.h5", "--png", "b.png", "--set", "relaxation.talus_angle=25"},
                  folder)
          .exit_code,
      0);
  const ProgramResult runs = run_program({"compare", "a.h5", "b.h5", "--report", "runs"}, folder);
  EXPECT_EQ(runs.exit_code, 1) << runs.err;
  EXPECT_EQ(
      drawn_page(folder / "runs/compare.html"),
      nlohmann::json({4, {"Checks", "Final height", "Both in 3-D", "Force and depth over time", "Files"}}));
  EXPECT_NE(read_file(folder / "runs/compare.html").find("talus_angle"), std::string::npos);
  const ProgramResult pictures = run_program({"compare", "a.png", "b.png", "--report", "pictures"}, folder);
  EXPECT_EQ(pictures.exit_code, 1) << pictures.err;
  EXPECT_EQ(drawn_page(folder / "pictures/compare.html"),
            nlohmann::json({0, {"Checks", "Picture", "Files"}}));
}

TEST_F(CliPages, ReportDrawsARunAndWhatItSaysAgreesWithTheRun) {
  const fs::path folder = test_folder();
  const ProgramResult run = run_program({"run", "scene.toml", "-o", "a.h5", "--json"}, folder);
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const ProgramResult report = run_program({"report", "a.h5"}, folder);
  EXPECT_EQ(report.exit_code, 0) << report.err;
  EXPECT_EQ(report.out, "a.html\n");
  const OpenedPage page =
      open_page(read_file(folder / "a.html"), "[" + page_state +
                                                  ", charts[2].drawn.getOption().series[0].data.at(-1)[1],"
                                                  " document.images[0].naturalWidth]");
  EXPECT_TRUE(page.console.empty()) << page.console.front();
  EXPECT_EQ(page.answer[0].dump(), R"(["true",5,0])");
  const double energy = nlohmann::json::parse(run.out)["absorbed_energy"];
  EXPECT_GT(energy, 0.0);
  EXPECT_NEAR(page.answer[1], energy, 1e-9 * energy);
  EXPECT_EQ(page.answer[2], 320);
}

TEST(CliReport, IsAPageAndNothingElse) {
  const fs::path folder = test_folder();
  ASSERT_EQ(run_program({"run", "scene.toml", "-o", "a.h5"}, folder).exit_code, 0);
  for (const std::string name : {"a.png", "a.pdf", "page"}) {
    const ProgramResult report = run_program({"report", "a.h5", "-o", name}, folder);
    EXPECT_EQ(report.exit_code, 2) << name;
    EXPECT_NE(report.err.find(name + ": is not a name for a page; end it with .html"), std::string::npos);
    EXPECT_FALSE(fs::exists(folder / name));
  }
}

TEST(CliReport, SaysWhyARunHasNoStrokeToShow) {
  const fs::path folder = test_folder();
  write_file(folder / "still.toml", "[bed]\nsize = [0.2, 0.2]\ncells = [40, 40]\n[view]\nsize = [160, 90]\n");
  ASSERT_EQ(run_program({"run", "still.toml"}, folder).exit_code, 0);
  ASSERT_EQ(run_program({"run", "scene.toml", "--set", "output.trace=false"}, folder).exit_code, 0);
  for (const auto& [name, reason] : {std::pair{"still", "the bed only came to rest"},
                                     {"scene", "run the scene with output.trace = true"}}) {
    const std::string file = name;
    const ProgramResult report = run_program({"report", file + ".h5"}, folder);
    EXPECT_EQ(report.exit_code, 0) << report.err;
    EXPECT_NE(read_file(folder / (file + ".html")).find(reason), std::string::npos) << reason;
  }
}

TEST_F(CliPages, GoldenCheckDrawsAnIndexAndAPageForEachScene) {
  const fs::path folder = test_folder();
  fs::create_directories(folder / "strokes/tiny");
  fs::rename(folder / "scene.toml", folder / "strokes/tiny/scene.toml");
  fs::rename(folder / "line.toml", folder / "strokes/tiny/line.toml");
  ASSERT_EQ(run_program({"golden", "update", "tiny"}, folder).exit_code, 0);
  ASSERT_EQ(run_program({"golden", "check", "--report", "report", "--all-pages"}, folder).exit_code, 0);
  EXPECT_EQ(drawn_page(folder / "report/index.html"), nlohmann::json({0, {"The scene is as it should be"}}));
  EXPECT_EQ(
      drawn_page(folder / "report/tiny.html"),
      nlohmann::json({4, {"Checks", "Change of height", "Picture", "Force and depth over time", "Files"}}));
}

TEST(CliStress, RefusesAFolderThatCannotBeWrittenBeforeAnyWork) {
  const fs::path folder = test_folder();
  write_file(folder / "file", "text");
  const ProgramResult run = run_program({"stress", "-o", "file"}, folder);
  EXPECT_EQ(run.exit_code, 4);
  EXPECT_NE(run.err.find("file"), std::string::npos) << run.err;
}

TEST(CliStress, StoppedBySignalItLeavesNothing) {
  if (sanitized) GTEST_SKIP() << "a case, after which it would stop, takes a minute";
  const fs::path folder = test_folder();
  const ProgramResult run = run_program({"stress", "-o", "out"}, folder, {SIGINT, 1000});
  EXPECT_EQ(run.exit_code, 130) << run.err;
  EXPECT_FALSE(fs::exists(folder / "out/stress.html"));
}

}  // namespace
}  // namespace sandstroke
