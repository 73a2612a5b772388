#pragma once

#include <filesystem>

#include "sim/scene.h"

namespace sandstroke {

/// The bed a scene starts from: procedural, or from a file (relative to `folder`): a run file's final
/// surface (the last one that it has, if the run was cut off), or a map (height_map.h), of which a picture's
/// black and white stand for surface.low and surface.high (with_own_range). Other cells than the scene's are
/// resampled by area means. Error: input or io, naming the file.
HeightField load_surface(const BedSettings& bed, const std::filesystem::path& folder);

/// load_surface() on the ground of the scene (on_ground). Warns if the scene has no floor and its surface is
/// a run with one, whose stones become sand. Error: as load_surface().
HeightField load_bed(const Scene& scene, const std::filesystem::path& folder);

/// The same bed. If its surface.low and high are equal, it takes those of its PNG (read_gray_range). Error:
/// as load_surface().
BedSettings with_own_range(BedSettings bed, const std::filesystem::path& folder);

}  // namespace sandstroke
