#pragma once

#include <filesystem>
#include <fstream>
#include <string_view>

#include "core/temporary_folder.h"

namespace sandstroke {

/// An empty folder of its own for a test, gone afterwards.
using TestFolder = TemporaryFolder;

/// Over whatever is there.
inline void put_text(const std::filesystem::path& path, std::string_view text) {
  std::ofstream(path, std::ios::binary) << text;
}

}  // namespace sandstroke
