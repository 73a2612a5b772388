// The view of the real program: a page at an address that it prints, and a pointer there as the hand.
#include <gtest/gtest.h>
#include <signal.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <regex>
#include <thread>

#include "cli/viewed_program.h"
#include "io/run_file.h"
#include "io/stroke_file.h"
#include "view/view_client.h"

namespace sandstroke {
namespace {

namespace fs = std::filesystem;

// Sand that does not relax, so that nothing but sampling differs between what was seen and what a run plays.
const std::vector<std::string> firm = {"--set", "relaxation.talus_angle=85", "--set", "relaxation.rate=0"};

std::vector<std::string> plus(std::vector<std::string> arguments, const std::vector<std::string>& more) {
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

TEST(CliView, APointerInAPageBecomesARecordingWhoseRunIsWhatWasSeen) {
  const fs::path folder = test_folder();
  Viewed recording(plus({"record", "--max-skipped", "100", "--device", "pointer", "--feel", "scene.toml",
                         "-o", "hand.h5", "--stop-switch", "3", "--no-open", "--json"},
                        firm),
                   folder);
  const std::string address = recording.address();
  ASSERT_NE(address, "");
  ViewClient page(address);
  ASSERT_TRUE(page.hear());
  EXPECT_EQ(page.said.at("hello").at("title"), "hand.h5");
  EXPECT_EQ(page.said.at("hello").at("pointer").at("radius"), 0.01);
  // Down, along a line at 0.1 m/s, up, at 60 Hz of the page's clock; the last sample ends the recording.
  constexpr double speed = 0.1;
  for (int k = 0; k <= 50; ++k) {  // pictures wait meanwhile, for a WebSocket is of one thread
    const double t = k / 60.0;
    page.point(1e3 * t, static_cast<float>(speed * (t - 0.4)), 0.0f, k < 5 || k > 44 ? 0.0f : 0.3f,
               k == 50 ? 8u : 0u);
    std::this_thread::sleep_for(std::chrono::duration<double>(1.0 / 60.0));
  }
  page.hear_to_end();
  const ProgramResult recorded = recording.end();
  ASSERT_EQ(recorded.exit_code, 0) << recorded.err;
  EXPECT_EQ(page.said.at("end"), "the stop switch was pressed");
  EXPECT_EQ(nlohmann::json::parse(recorded.out)["source"], "pointer");

  ASSERT_EQ(run_program(plus({"run", "scene.toml", "--stroke", "hand.h5", "-o", "hand-run.h5"}, firm), folder)
                .exit_code,
            0);
  const HeightField run = last_surface(RunFile(folder / "hand-run.h5")).surface;
  const Stroke stroke = read_stroke_file(folder / "hand.h5");
  double way = 0.0;  // m, from a sample to the next
  for (std::size_t i = 1; i < stroke.size(); ++i)
    way = std::max(way, (stroke.position[i] - stroke.position[i - 1]).norm());
  double deepest = 0.0, apart = 0.0;
  for (int row = 0; row < run.rows(); ++row)
    for (int col = 0; col < run.cols(); ++col) {
      deepest = std::min(deepest, run(row, col));
      apart = std::max(apart, std::abs(run(row, col) - static_cast<double>(page.height(row, col))));
    }
  EXPECT_LT(deepest, -0.002);
  // Both hands are between the same two samples. Where the tool is moved by so much, its underside (of slope
  // 0.85 at most) and the sand beside it change by less than twice that.
  EXPECT_LE(apart, 2.0 * way);
  RecordProperty("apart", std::to_string(apart));
}

TEST(CliView, ClosingAPageChangesNothingInARecording) {
  const fs::path folder = test_folder();
  Viewed recording({"record", "--max-skipped", "100", "--device", "scripted:line.toml", "--feel",
                    "scene.toml", "--view", "--no-open", "-o", "a.h5", "--json"},
                   folder);
  const std::string address = recording.address();
  {
    ViewClient page(address);
    EXPECT_TRUE(page.hear_until([&] { return page.picture.has_value(); }));
    EXPECT_TRUE(page.said.at("hello").at("pointer").is_null());
    page.vanish();
  }
  ViewClient again(address);
  again.hear_to_end();
  EXPECT_EQ(again.said.at("end"), "the stroke played was over");
  EXPECT_EQ(again.picture->flags & 2u, 2u);
  EXPECT_NEAR(again.picture->tip[0], 0.05, 1e-3);  // where the stroke ends
  const ProgramResult result = recording.end();
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const nlohmann::json said = nlohmann::json::parse(result.out);
  EXPECT_TRUE(said["complete"]);
  EXPECT_EQ(said["ticks_elapsed"],
            std::llround(1000.0 * load_stroke(folder / "line.toml", {}).duration()) + 1);
}

TEST(CliView, ARunBeforePagesTakesItsTimeAndIsTheSame) {
  const fs::path folder = test_folder();
  ASSERT_EQ(run_program({"run", "scene.toml", "-o", "a.h5"}, folder).exit_code, 0);
  Viewed running({"run", "scene.toml", "-o", "b.h5", "--view", "--no-open", "--json"}, folder);
  ViewClient page(running.address());
  page.hear_to_end();
  EXPECT_EQ(page.said.at("end"), "the run is complete");
  const ProgramResult result = running.end();
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_LE(nlohmann::json::parse(result.out)["real_time_factor"], 1.01);
  const HeightField without = last_surface(RunFile(folder / "a.h5")).surface,
                    with = last_surface(RunFile(folder / "b.h5")).surface;
  EXPECT_TRUE((without.grid() == with.grid()).all());
  for (int row = 0; row < with.rows(); ++row)
    for (int col = 0; col < with.cols(); ++col)
      ASSERT_EQ(page.height(row, col), static_cast<float>(with(row, col)));
}

TEST(CliView, ARunThatNobodyWatchesCanBeEnded) {
  const fs::path folder = test_folder();
  Conditions interrupted;
  interrupted.signal = SIGINT;
  interrupted.when = [err = folder / "err.txt"] {
    return read_file(err).find("begins when a page is open") != std::string::npos;
  };
  Viewed running({"run", "scene.toml", "-o", "a.h5", "--view", "--no-open"}, folder, interrupted);
  EXPECT_EQ(running.end().exit_code, 128 + SIGINT);
}

TEST(CliView, SandThatOnlyRelaxesIsShownToo) {
  const fs::path folder = test_folder();
  const std::vector<std::string> pile = {"--set", "bed.surface.kind=\"cone\"",
                                         "--set", "bed.surface.height=0.05",
                                         "--set", "bed.surface.radius=0.05"};
  write_file(folder / "pile.toml", "[bed]\nsize = [0.3, 0.2]\ncells = [150, 100]\n");
  Viewed running(plus({"run", "pile.toml", "-o", "a.h5", "--view", "--no-open"}, pile), folder);
  ViewClient page(running.address());
  page.hear_to_end();
  ASSERT_EQ(running.end().exit_code, 0);
  const HeightField end = last_surface(RunFile(folder / "a.h5")).surface;
  for (int row = 0; row < end.rows(); ++row)
    for (int col = 0; col < end.cols(); ++col)
      ASSERT_EQ(page.height(row, col), static_cast<float>(end(row, col)));
}

TEST(CliView, TheAddressIsOpenedWhereThereIsADesktop) {
  const fs::path folder = test_folder();
  fs::create_directory(folder / "bin");
  write_file(folder / "bin/xdg-open", "#!/bin/sh\ncat \"$1\" > opened.txt\n");
  fs::permissions(folder / "bin/xdg-open", fs::perms::owner_all);
  const auto opened = [&](bool desktop, bool ci, bool no_open) {
    fs::remove(folder / "opened.txt");
    Conditions conditions;
    conditions.path = (folder / "bin").string() + ":/usr/bin:/bin";
    conditions.in_child = [=] {
      unsetenv("WAYLAND_DISPLAY");
      unsetenv("DISPLAY");
      unsetenv("CI");
      if (desktop) setenv("DISPLAY", ":99", 1);
      if (ci) setenv("CI", "true", 1);
    };
    std::vector<std::string> arguments = {"record",     "--device", "pointer", "--feel",
                                          "scene.toml", "-o",       "a.h5",    "--overwrite"};
    if (no_open) arguments.push_back("--no-open");
    if (desktop && !ci && !no_open) {  // until it is open
      conditions.signal = SIGTERM;
      conditions.when = [&] { return read_file(folder / "opened.txt").ends_with('\n'); };
    } else {
      arguments.insert(arguments.end(), {"--duration", "0.05"});
    }
    const ProgramResult result = run_program(arguments, folder, conditions);
    EXPECT_NE(result.err.find("ssh -L "), std::string::npos) << result.err;
    if (!fs::exists(folder / "opened.txt")) return false;
    std::smatch address;  // on a page of the user's own, for command lines are everybody's
    const std::string page = read_file(folder / "opened.txt");
    EXPECT_TRUE(std::regex_search(page, address, std::regex("url=(http[^\"]*)\"")));
    EXPECT_NE(result.err.find("view: " + address.str(1) + "\n"), std::string::npos);
    return true;
  };
  EXPECT_TRUE(opened(true, false, false));
  EXPECT_FALSE(opened(false, false, false));
  EXPECT_FALSE(opened(true, true, false));
  EXPECT_FALSE(opened(true, false, true));
}

TEST(CliView, WhatCannotBeViewedIsSaid) {
  const fs::path folder = test_folder();
  const std::vector<std::pair<std::vector<std::string>, std::string>> attempts = {
      {{"record", "-o", "a.h5", "--device", "pointer"}, "--feel"},
      {{"record", "-o", "a.h5", "--device", "scripted:line.toml", "--view"}, "--feel"},
      {{"run", "scene.toml", "--no-open"}, "--view"},
      {{"record", "-o", "a.h5", "--device", "scripted:line.toml", "--no-open"}, "--view"},
      {{"record", "-o", "a.h5", "--device", "scripted:line.toml", "--max-skipped", "nan"}, "--max-skipped"}};
  for (const auto& [arguments, part] : attempts) {
    const ProgramResult result = run_program(arguments, folder);
    EXPECT_EQ(result.exit_code, 2) << result.err;
    EXPECT_NE(result.err.find(part), std::string::npos) << result.err;
    EXPECT_FALSE(fs::exists(folder / "a.h5"));
  }
}

}  // namespace
}  // namespace sandstroke
