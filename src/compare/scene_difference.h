#pragma once

#include <string>

namespace sandstroke {

/// The settings in which two resolved scenes (TOML) differ, with both values: "tool.radius was 0.01, is
/// 0.02"; empty where they are the same. A setting that is newer than the golden scene counts there with its
/// default. Error: input, where either is no TOML.
std::string scene_difference(const std::string& golden, const std::string& run);

}  // namespace sandstroke
