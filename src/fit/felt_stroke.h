#pragma once

#include <filesystem>

#include "sim/simulation.h"

namespace sandstroke {

/// The input of a fit. In the scene the device follows the stroke (device.model = "kinematic"), so that sand,
/// depths and velocities do not depend on the constants. The stroke has forces and is placed on the bed.
struct FeltStroke {
  Scene scene;
  HeightField bed;
  Stroke stroke;
};

/// Loads the input of a fit from the scene's files. Error: input, if the scene has no stroke or the stroke no
/// forces; io.
FeltStroke felt_stroke(const Scene& scene, const std::filesystem::path& scene_folder);

}  // namespace sandstroke
