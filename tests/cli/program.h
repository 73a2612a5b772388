#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace sandstroke {

/// The end of a run of the real program.
struct ProgramResult {
  int exit_code = -1;  ///< 128 + signal, if one ended it
  std::string out, err;
  double peak_memory = 0.0;  ///< bytes, resident
};

/// The conditions that a run of the program meets with.
struct Conditions {
  int signal = 0;                       ///< sent to it ...
  double after_ms = 0.0;                ///< ... so long after its start ...
  std::size_t most_file_bytes = 0;      ///< ulimit -f: no file grows beyond; 0: no limit
  const char* out = nullptr;            ///< where its standard output goes instead
  std::function<bool()> when = {};      ///< ... or, where there is one, as soon as this holds
  std::string path = {};                ///< where it finds other programs, instead of PATH
  bool real_time_refused = false;       ///< no permission for real-time scheduling, nor for locked memory
  std::function<void()> in_child = {};  ///< what else befalls it: called where it is about to start
};

/// Runs build/.../sandstroke with these arguments in a folder.
ProgramResult run_program(const std::vector<std::string>& arguments, const std::filesystem::path& folder,
                          const Conditions& conditions = {});

/// Expects that `run` refuses a scene with these settings by that sentence, and leaves no file.
void expect_run_refused(const std::string& scene, const std::vector<std::string>& settings,
                        const std::string& sentence, const std::filesystem::path& folder);

/// A fresh folder for one test, with a small scene and stroke in it: scene.toml, line.toml. Gone when all
/// tests have passed.
std::filesystem::path test_folder();

void write_file(const std::filesystem::path& path, const std::string& text);
std::string read_file(const std::filesystem::path& path);

}  // namespace sandstroke
