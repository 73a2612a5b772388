#pragma once

#include <filesystem>

namespace sandstroke {

/// Puts a complete folder in the place of another one, or where there is none yet. At any moment the place
/// holds all old or all new. Only where the file system cannot exchange two names is it empty for a moment; a
/// program killed then leaves the old one as PLACE.old.part. Afterwards `made` is the old one, or is gone.
/// Error: std::filesystem::filesystem_error; the old folder is then in its place.
void replace_folder(const std::filesystem::path& made, const std::filesystem::path& place);

}  // namespace sandstroke
