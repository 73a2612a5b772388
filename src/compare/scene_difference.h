#pragma once

#include <string>

namespace sandstroke {

/// The settings in which two resolved scenes (TOML) differ, with both values: "tool.radius was 0.01, is
/// 0.02"; a setting that the golden scene's build did not have yet had its default; empty where they are the
/// same. Error: input, where either is no TOML.
std::string scene_difference(const std::string& golden, const std::string& run);

}  // namespace sandstroke
