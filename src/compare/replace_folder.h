#pragma once

#include <filesystem>

namespace sandstroke {

/// Puts a complete folder in the place of another one, or where there is none yet: all old or all new at any
/// moment. Only where the file system cannot exchange two names there is neither for a moment: killed then,
/// it leaves the old one as PLACE.old.part. Afterwards `made` is the old one, or not there. Error:
/// std::filesystem::filesystem_error, with what was there in its place.
void replace_folder(const std::filesystem::path& made, const std::filesystem::path& place);

}  // namespace sandstroke
