#pragma once

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "run/run_scene.h"

namespace sandstroke {

/// A scene, and the folder to which its files are relative.
struct SceneHere {
  SceneFile scene;
  std::filesystem::path folder;
};

/// A run in memory, from a simulation or from a file.
struct KeptRun {
  SceneHere scene;
  std::string path;                ///< of its file; empty: none
  nlohmann::ordered_json summary;  ///< as `run --json`; of a file: what it tells
  BedGeometry bed{1, 1, 1.0};
  HeightGrid initial, final;  ///< m
  HeightGrid floor;           ///< m, not-a-number where there is none; empty: none at all
  TraceContent content;
  std::vector<TickRecord> trace;
  std::vector<RelaxationRecord> relaxations;
  std::vector<double> frame_times;  ///< s
  std::vector<double> frames;       ///< m, one after the other
};

/// The floor of a ground as Python has it [m]: not-a-number where there is none.
HeightGrid floor_grid(const Ground& ground);

/// Makes the bed of a scene with these heights [m]. Error: input, if their shape is not that of bed.cells, or
/// if some are missing (not-a-number) or beyond all sense.
HeightField surface_of(const Scene& scene, HeightGrid heights);

/// Runs a scene. Without stroke or surface it takes the scene's. Writes no file if output is empty. Call it
/// with the interpreter lock, which it releases. Errors as in run_scene.
std::shared_ptr<KeptRun> kept_run(const SceneHere& scene, std::optional<Stroke> stroke,
                                  std::optional<HeightField> surface, const std::filesystem::path& output,
                                  int threads);
std::shared_ptr<KeptRun> read_run(const std::filesystem::path& path);

}  // namespace sandstroke
