#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "io/scene_file.h"
#include "io/scene_toml.h"
#include "measure/error_estimate.h"
#include "sweep/sweep_design.h"

namespace sandstroke {

/// A sweep's plan, read from TOML: all_plan_keys().
struct SweepPlan {
  std::filesystem::path file, scene;
  std::string scene_text;
  std::vector<std::string> settings;  ///< "key=value" of every point
  SweepDesign design;
  std::vector<std::string> metrics;  ///< names
  bool keep_surface = false, keep_picture = false;
  std::filesystem::path golden;          ///< empty: none
  std::optional<SecondSolution> second;  ///< the solution for estimating each point's error
  std::vector<std::string> notes;        ///< for each kind that an axis sets, what its points leave out

  /// The scene with these settings, without those that do not apply. Error: input, if they contradict each
  /// other.
  SceneFile scene_with(const std::vector<std::string>& all_settings) const;
  SceneFile scene_with(const std::vector<std::string>& all_settings, std::vector<LeftOut>& left_out) const;
  SceneFile scene_of(std::size_t point) const;
  /// The folder to which file names in scenes are relative.
  std::filesystem::path scene_folder() const { return scene.parent_path(); }
};

/// Reads a plan, and checks that all files exist, that each value of each axis (100 of a range) works with
/// the first values of the others (or, where it does not apply with them, with others), and that each setting
/// applies somewhere. Error: input, naming file, line, key and remedy; io.
SweepPlan load_plan(const std::filesystem::path& path);

}  // namespace sandstroke
