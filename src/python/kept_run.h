#pragma once

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "run/run_scene.h"

namespace sandstroke {

/// A scene, and what its files are relative to.
struct SceneHere {
  Scene scene;
  std::filesystem::path folder;
};

/// A run in memory: of a simulation, or of its file.
struct KeptRun {
  SceneHere scene;
  std::string path;                ///< of its file; empty: there is none
  nlohmann::ordered_json summary;  ///< `run --json`; of a file: null
  BedGeometry bed{1, 1, 1.0};
  HeightGrid initial, final;  ///< m
  TraceContent content;
  std::vector<TickRecord> trace;
  std::vector<RelaxationRecord> relaxations;
  std::vector<double> frame_times;  ///< s
  std::vector<double> frames;       ///< m, one after the other
};

/// The bed of a scene with these heights [m]. Error: input, where they are not those of its cells.
HeightField surface_of(const Scene& scene, const HeightGrid& heights);

/// stroke, surface: none: the scene's. output: empty: no file is written. Called with the interpreter held,
/// which it lets go. Errors as run_scene.
std::shared_ptr<KeptRun> kept_run(const SceneHere& scene, std::optional<Stroke> stroke,
                                  std::optional<HeightField> surface, const std::filesystem::path& output,
                                  int threads);
std::shared_ptr<KeptRun> read_run(const std::filesystem::path& path);

}  // namespace sandstroke
