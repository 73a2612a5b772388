#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "picture/image.h"
#include "sand/height_field.h"

namespace sandstroke {

// Pictures for people who look into a failed comparison: golden, run and difference (run - golden) side by
// side, blue below and red above, with the numbers.

/// Two surfaces, or changes of height, of one bed [m]. The difference's colours span at least +-limit [m],
/// and each of its spots shows the largest difference in it, so that a single cell can be seen. Surfaces of
/// different shapes are shown without a difference.
Image surface_report(const std::string& title, const HeightGrid& golden, const HeightGrid& run,
                     double cell_size, double limit);

/// Two pictures. The difference shows each pixel's channel that differs most; its colours span at least
/// +-limit (of 255). Pictures of different sizes are shown without a difference.
Image picture_report(const std::string& title, const Image& golden, const Image& run, int limit);

/// Draws one and writes it as PNG; makes the folder. Nothing where `draw` finds its data missing or damaged
/// (Error: input): that is a failed check already. Error: io.
void write_report(const std::filesystem::path& path, const std::function<Image()>& draw);

}  // namespace sandstroke
