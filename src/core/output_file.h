#pragma once

#include <filesystem>
#include <string_view>

namespace sandstroke {

/// The name under which PATH is written until it is complete: PATH.part.
std::filesystem::path part_path(const std::filesystem::path& path);

/// Gives a complete PATH.part its final name. Error: io.
void finish_part(const std::filesystem::path& path);

/// Writes a whole text file by way of PATH.part, so that PATH is either complete or untouched. Error: io.
void write_text_file(const std::filesystem::path& path, std::string_view text);

/// Reads a whole text file. Error: io, with what to do.
std::string read_text_file(const std::filesystem::path& path);

}  // namespace sandstroke
