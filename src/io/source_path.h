#pragma once

#include <filesystem>
#include <vector>

#include "sim/source_settings.h"

namespace sandstroke {

/// The same sources, with the strokes that their nozzles follow (path, relative to `folder`) loaded. Error:
/// input or io, naming the file.
std::vector<SourceSettings> with_paths(std::vector<SourceSettings> sources,
                                       const std::filesystem::path& folder);

}  // namespace sandstroke
