#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "haptics/table_settings.h"

namespace sandstroke {

/// The samples' name in messages.
std::string samples_name(const std::filesystem::path& path);

/// The files that are read: this one, unless it is standard input, and the table that is merged with it.
std::vector<std::filesystem::path> sample_files(const std::filesystem::path& path,
                                                const TableSettings& settings);

}  // namespace sandstroke
