#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace sandstroke {

/// How a run of the real program ended.
struct ProgramResult {
  int exit_code = -1;  ///< 128 + signal, if one ended it
  std::string out, err;
};

/// Runs build/.../sandstroke with these arguments in a folder. signal_after_ms >= 0: sends it SIGINT then.
ProgramResult run_program(const std::vector<std::string>& arguments, const std::filesystem::path& folder,
                          int signal_after_ms = -1);

/// A fresh folder for one test, with a small scene and stroke in it: scene.toml, line.toml.
std::filesystem::path test_folder();

void write_file(const std::filesystem::path& path, const std::string& text);
std::string read_file(const std::filesystem::path& path);

}  // namespace sandstroke
