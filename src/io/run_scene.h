#pragma once

#include <filesystem>

#include "sim/run_result.h"
#include "sim/scene.h"

namespace sandstroke {

struct RunOptions {
  std::filesystem::path scene_folder = ".";  ///< what file names in the scene are relative to
  int threads = 0;                           ///< 0: all cores
  bool progress = false;                     ///< a bar on the terminal
};

/// Loads bed and stroke, simulates, and writes the run file. Error: input or io.
RunResult run_scene(const Scene& scene, const std::filesystem::path& output, const RunOptions& options);

}  // namespace sandstroke
