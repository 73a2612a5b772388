#pragma once

#include <filesystem>
#include <optional>

#include "sim/error_estimate.h"
#include "sim/run_result.h"
#include "sim/scene.h"

namespace sandstroke {

struct RunOptions {
  std::filesystem::path scene_folder = ".";  ///< what file names in the scene are relative to
  int threads = 0;                           ///< 0: all cores
  bool progress = false;                     ///< a bar on the terminal
  std::optional<SecondSolution> second;      ///< estimate the error, from this
};

/// Loads bed and stroke, simulates, writes the run file, and then, where asked, estimates its error: none
/// where it was interrupted, or where the second solution is unstable, which it warns of. Error: input, io or
/// unstable.
RunResult run_scene(const Scene& scene, const std::filesystem::path& output, const RunOptions& options);

}  // namespace sandstroke
