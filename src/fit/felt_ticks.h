#pragma once

#include <filesystem>
#include <vector>

#include "fit/force_fit.h"
#include "sim/scene.h"

namespace sandstroke {

/// What a run of the scene gives a fit: the ticks in which its tool touches sand, at the time of a recorded
/// force. The device follows the stroke (device.model = "kinematic", whatever the scene says), so that depths
/// and velocities do not hang on the constants. Shows a bar; empty where it was interrupted. Error: input,
/// where the scene has no stroke or the stroke no forces; io; unstable.
std::vector<FeltTick> felt_ticks(const Scene& scene, const std::filesystem::path& scene_folder);

}  // namespace sandstroke
