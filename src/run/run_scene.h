#pragma once

#include <filesystem>
#include <functional>
#include <optional>

#include "sim/error_estimate.h"
#include "sim/run_result.h"
#include "sim/scene.h"
#include "sim/simulation.h"

namespace sandstroke {

struct RunOptions {
  std::filesystem::path scene_folder = ".";  ///< what file names in the scene are relative to
  std::filesystem::path scene_file;          ///< for /provenance; empty: there is none
  int threads = 0;                           ///< 0: all cores
  bool progress = false;                     ///< a bar on the terminal
  std::optional<SecondSolution> second;      ///< estimate the error, from this
  /// Who else is told of the simulation that is about to run; none: nobody. It outlives the run.
  std::function<SimulationObserver&(const Simulation&)> onlooker;
  bool error_map = false;        ///< and keep the error of each cell's height
  std::optional<Stroke> stroke;  ///< samples to play instead of the file that the scene's [stroke] names
  std::optional<HeightField> surface;  ///< to start from, instead of the scene's
  /// Is shown the simulation after its run, which may have been interrupted; none: nobody.
  std::function<void(const Simulation&, const RunResult&)> at_end;
};

/// The scene with what its files hold besides stroke and surface: the range of a PNG's heights, the tool's
/// mesh, a plugin's laws. Files are relative to `folder`. Error: io, input.
Scene with_files(Scene scene, const std::filesystem::path& folder);

/// The scene's stroke, from that file, as it is played, and the hash of its content. Warns of what it leaves
/// out. Error: io, input.
Stroke placed_stroke(const Scene& scene, const std::filesystem::path& path, std::string& hash);

/// What /provenance/scene_file says: where the scene lies, seen from the run's folder, so that both can be
/// moved together.
std::string scene_file_entry(const std::filesystem::path& scene_file, const std::filesystem::path& run_file);

/// Loads bed and stroke, simulates, writes the run file (output empty: none), and then, where asked,
/// estimates its error: none where it was interrupted, or where the second solution is unstable, which it
/// warns of. Error: input, io or unstable.
RunResult run_scene(const Scene& scene, const std::filesystem::path& output, const RunOptions& options);

}  // namespace sandstroke
