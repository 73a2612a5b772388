// The pages that bench and stress leave, from quick runs of the program, in headless Chromium.
#include <gtest/gtest.h>

#include <csignal>
#include <nlohmann/json.hpp>

#include "chromium.h"
#include "cli/program.h"

namespace sandstroke {
namespace {

namespace fs = std::filesystem;

using CliPages = ChromiumTest;

TEST_F(CliPages, BenchDrawsEveryProblem) {
  const fs::path folder = test_folder();
  const ProgramResult run =
      run_program({"bench", "--quick", "--repeats", "1", "-o", "out", "--json"}, folder);
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const nlohmann::json data = nlohmann::json::parse(run.out);
  EXPECT_GE(data["problems"].size(), 11u);
  const OpenedPage page = open_in_chromium(read_file(folder / "out/bench.html"), page_state);
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
  const OpenedPage page = open_in_chromium(read_file(folder / "out/stress.html"), page_state);
  EXPECT_TRUE(page.console.empty()) << page.console.front();
  EXPECT_EQ(page.answer[0], "true");
  EXPECT_EQ(page.answer[2], 0);
  EXPECT_GE(page.answer[1], data["maps"].size() + data["traces"].size());
}

TEST(CliStress, RefusesAFolderThatCannotBeWrittenBeforeAnyWork) {
  const fs::path folder = test_folder();
  write_file(folder / "file", "text");
  const ProgramResult run = run_program({"stress", "-o", "file"}, folder);
  EXPECT_EQ(run.exit_code, 4);
  EXPECT_NE(run.err.find("file"), std::string::npos) << run.err;
}

TEST(CliStress, StoppedBySignalItLeavesNothing) {
  const fs::path folder = test_folder();
  const ProgramResult run = run_program({"stress", "-o", "out"}, folder, {SIGINT, 1000});
  EXPECT_EQ(run.exit_code, 130) << run.err;
  EXPECT_FALSE(fs::exists(folder / "out/stress.html"));
}

}  // namespace
}  // namespace sandstroke
