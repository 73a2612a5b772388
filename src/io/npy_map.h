#pragma once

#include <filesystem>
#include <memory>

#include "io/height_map.h"

namespace sandstroke {

/// Opens a NumPy array (.npy) of two dimensions: heights [m], rows along y, the first with the smallest y, as
/// in run files. Error: input; io.
std::unique_ptr<HeightMap> open_npy_map(const std::filesystem::path& path);

}  // namespace sandstroke
