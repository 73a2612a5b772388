#include <gtest/gtest.h>

#include <regex>
#include <sstream>

#include "cli/program.h"
#include "io/scene_keys.h"
#include "io/scene_toml.h"
#include "sanitized.h"

namespace sandstroke {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> lines_of(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

std::vector<std::string> words_of(const std::string& line) {
  std::istringstream stream(line);
  return {std::istream_iterator<std::string>(stream), {}};
}

/// A fresh folder with the example in it.
fs::path example() {
  const fs::path folder = test_folder();
  EXPECT_EQ(run_program({"init", "garden"}, folder).exit_code, 0);
  return folder / "garden";
}

TEST(CliInit, WhatItSaysToTypeNextWorks) {
  const fs::path folder = test_folder();
  const ProgramResult init = run_program({"init", "garden"}, folder);
  ASSERT_EQ(init.exit_code, 0) << init.err;
  int commands = 0;
  for (const std::string& line : lines_of(init.out)) {
    if (!line.starts_with("  sandstroke ")) continue;
    std::vector<std::string> words = words_of(line);
    words.erase(words.begin());
    if (words.front() == "sweep") words.push_back("--dry-run");
    const ProgramResult result = run_program(words, folder);
    EXPECT_EQ(result.exit_code, 0) << line << '\n' << result.err;
    EXPECT_EQ(result.err.find("warning"), std::string::npos) << result.err;
    ++commands;
  }
  EXPECT_EQ(commands, 3);  // run, render, sweep
  EXPECT_TRUE(fs::exists(folder / "garden/run.png"));
}

TEST(CliInit, WritesOverNothing) {
  for (const char* there : {"scene.toml", "stroke.toml", "sweep.toml"}) {
    const fs::path folder = test_folder() / "garden";
    fs::create_directories(folder);
    write_file(folder / there, "mine");
    const ProgramResult again = run_program({"init", folder.string()}, folder);
    EXPECT_EQ(again.exit_code, 2);
    EXPECT_NE(again.err.find(there), std::string::npos) << again.err;
    EXPECT_EQ(read_file(folder / there), "mine");
    for (const char* other : {"scene.toml", "stroke.toml", "sweep.toml"})
      EXPECT_EQ(fs::exists(folder / other), std::string(other) == there);
  }
}

TEST(CliInit, AFullDiskLeavesNothing) {
  if (threads_sanitized) GTEST_SKIP() << "the sanitizer's own memory is a file";
  const fs::path folder = test_folder();
  ASSERT_EQ(run_program({"init", "whole"}, folder).exit_code, 0);
  Conditions conditions;
  conditions.most_file_bytes = fs::file_size(folder / "whole/stroke.toml") - 1;
  EXPECT_EQ(run_program({"init", "garden"}, folder, conditions).exit_code, 4);
  EXPECT_TRUE(fs::is_empty(folder / "garden"));
  EXPECT_EQ(run_program({"init", "garden"}, folder).exit_code, 0);
}

TEST(CliInit, SettingsInCommentsAreTheDefaults) {
  const fs::path scene = example() / "scene.toml";
  const std::string with_comments =
      std::regex_replace(read_file(scene), std::regex("(^|\n)# (\\w+ = )"), "$1$2");
  EXPECT_NE(with_comments, read_file(scene));
  EXPECT_EQ(scene_text(scene_from_text(with_comments, "with comments")), scene_text(load_scene(scene)));
}

TEST(CliInit, CommentsNameTheUnits) {
  const fs::path file = example() / "scene.toml";
  const SceneFile scene = load_scene(file);
  std::string section;
  int units = 0;
  for (const std::string& line : lines_of(read_file(file))) {
    std::smatch found;
    if (std::regex_search(line, found, std::regex("^\\[([\\w.]+)\\]"))) section = found[1];
    if (!std::regex_search(line, found, std::regex("^(?:# )?(\\w+) = [^#]*(?:# (?:\\[(.*?)\\])?|$)")))
      continue;
    const std::string unit = setting_unit(scene, section + "." + found[1].str());
    EXPECT_EQ(found[2].str(), unit) << line;
    units += !unit.empty();
  }
  EXPECT_GT(units, 8);
}

}  // namespace
}  // namespace sandstroke
