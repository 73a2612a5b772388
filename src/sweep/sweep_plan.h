#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "sim/scene.h"
#include "sweep/sweep_design.h"

namespace sandstroke {

/// What is to be swept, as a plan (TOML) says:
///
///   [sweep]
///   scene = "scene.toml"                # what every point starts from; files are relative to the plan
///   strokes = ["a.toml", "b.h5"]        # instead of the scene's: the first axis, stroke.file
///   design = "grid"                     # every combination; or "latin": `samples` points by `seed`
///   metrics = ["max_force", "work"]     # default: all
///   keep = ["surface", "picture"]       # of each point, besides its metrics; default: nothing
///   golden = "golden.h5"                # run whose final surface each point's is compared with
///   max_points = 10000                  # more are refused
///   [set]                               # settings of every point, by their names in a scene
///   bed.cells = [500, 500]
///   [axes]                              # what varies; the last one fastest
///   relaxation.talus_angle = { from = 20, to = 45, step = 2.5 }
///   force.k_s = { from = 10, to = 1e4, count = 7, scale = "log" }
///   model.preset = ["paper", "accurate"]
struct SweepPlan {
  std::filesystem::path file, scene;
  std::string scene_text;
  std::vector<std::string> settings;  ///< "key=value" of every point
  SweepDesign design;
  std::vector<std::string> metrics;  ///< names
  bool keep_surface = false, keep_picture = false;
  std::filesystem::path golden;  ///< empty: none

  /// The scene of a point. Error: input, where its settings do not go together.
  Scene scene_of(std::size_t point) const;
  /// What file names in scenes are relative to.
  std::filesystem::path scene_folder() const { return scene.parent_path(); }
};

/// Reads a plan and checks each value of each axis, beside the first values of the others, and all files'
/// being there. Error: input, naming file, line, key and remedy; io.
SweepPlan load_plan(const std::filesystem::path& path);

}  // namespace sandstroke
