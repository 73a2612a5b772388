#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace sandstroke {

/// The name under which PATH is written until it is complete: PATH.part.
std::filesystem::path part_path(const std::filesystem::path& path);

/// Refuses, before any work is done, an output that would destroy something or cannot be: one of the inputs
/// or of the other outputs, a folder, a device, or a place in a folder that is not there. Error: input or io.
void check_output(const std::filesystem::path& output, const std::vector<std::filesystem::path>& others);

/// Makes a folder, and those above it, unless it is there. Error: io, if that fails or nothing can be written
/// in it.
void make_folder(const std::filesystem::path& folder);

/// PATH with its ending .h5 or .hdf5 replaced; any other name keeps its dots ("run-27.5").
std::filesystem::path beside(const std::filesystem::path& path, const std::string& ending);

/// Writes a complete PATH.part through to the disk and gives it its final name. Error: io.
void finish_part(const std::filesystem::path& path);

/// Writes a whole file, of text or any bytes, by way of PATH.part, so that PATH is either complete or
/// untouched. Error: io.
void write_text_file(const std::filesystem::path& path, std::string_view text);

/// Error: io, unless the file is there and can be read.
void check_readable(const std::filesystem::path& path);

/// Reads a whole text file. Error: io, with what to do.
std::string read_text_file(const std::filesystem::path& path);

}  // namespace sandstroke
