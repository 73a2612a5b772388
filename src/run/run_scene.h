#pragma once

#include <filesystem>
#include <functional>
#include <optional>

#include "io/scene_file.h"
#include "measure/error_estimate.h"
#include "sim/run_result.h"
#include "sim/simulation.h"

namespace sandstroke {

struct RunOptions {
  std::filesystem::path scene_folder = ".";  ///< the scene's file names are relative to it
  std::filesystem::path scene_file;          ///< for /provenance; empty: no file
  int threads = 0;                           ///< 0: all cores
  bool progress = false;                     ///< a bar on the terminal
  std::optional<SecondSolution> second;      ///< if given, estimate the error with this solution
  /// Gives another observer of the simulation that is about to run. It must outlive the run. Empty: none.
  std::function<SimulationObserver&(Simulation&)> onlooker;
  bool error_map = false;        ///< with `second`: keep the error of each cell's height
  std::optional<Stroke> stroke;  ///< samples to play instead of the file that the scene's [stroke] names
  std::optional<HeightField> surface;  ///< to start from, instead of the scene's surface
  double checkpoint = 0.0;  ///< s, after which the run's state is kept beside its file again; 0: never
  bool resume = false;      ///< go on from a state, if there is one (io/run_state.h)
  /// Called with the simulation after its run, even if that was interrupted. Empty: not called.
  std::function<void(const Simulation&, const RunResult&)> at_end;
};

/// The scene with the content of its files, except stroke and surface: the range of a PNG's heights, the
/// tool's mesh, a plugin's laws. File names are relative to `folder`. Error: io, input.
Scene with_files(Scene scene, const std::filesystem::path& folder);

/// Loads the scene's stroke from that file, as it is played, and sets the hash of its content. Warns of what
/// it leaves out. Error: io, input.
Stroke placed_stroke(const Scene& scene, const std::filesystem::path& path, std::string& hash);

/// The value of /provenance/scene_file: the scene's path from the run's folder, so that both can be moved
/// together.
std::string scene_file_entry(const std::filesystem::path& scene_file, const std::filesystem::path& run_file);

/// Loads bed and stroke, simulates, writes the run file (output empty: none) and, if asked, estimates the
/// error. The result has the warnings that were given. There is no estimate if the run was interrupted, or if
/// the second solution is unstable; it warns of the latter. Error: input, io or unstable.
RunResult run_scene(const SceneFile& scene, const std::filesystem::path& output, const RunOptions& options);

}  // namespace sandstroke
