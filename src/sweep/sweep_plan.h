#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "sim/error_estimate.h"
#include "sweep/sweep_design.h"

namespace sandstroke {

/// What is to be swept, as a plan (TOML) says: all_plan_keys().
struct SweepPlan {
  std::filesystem::path file, scene;
  std::string scene_text;
  std::vector<std::string> settings;  ///< "key=value" of every point
  SweepDesign design;
  std::vector<std::string> metrics;  ///< names
  bool keep_surface = false, keep_picture = false;
  std::filesystem::path golden;          ///< empty: none
  std::optional<SecondSolution> second;  ///< estimate each point's error, from this

  /// The scene with these settings. Error: input, where they do not go together.
  Scene scene_with(const std::vector<std::string>& all_settings) const;
  Scene scene_of(std::size_t point) const;
  /// What file names in scenes are relative to.
  std::filesystem::path scene_folder() const { return scene.parent_path(); }
};

/// Reads a plan and checks each value of each axis, beside the first values of the others, and all files'
/// being there. Error: input, naming file, line, key and remedy; io.
SweepPlan load_plan(const std::filesystem::path& path);

}  // namespace sandstroke
