#pragma once

#include <filesystem>
#include <string>

namespace sandstroke {

/// The content of a file of the program, read wholly, as a hash: of an HDF5 file every number and text (but
/// for times that were measured), of a picture its pixels, of text its bytes. Error: std::runtime_error,
/// where it is cut off, damaged, or says itself that it is incomplete.
std::string content_of(const std::filesystem::path& file);

/// True if all that an HDF5 file holds can be read, complete or not.
bool can_be_read(const std::filesystem::path& part);

/// The first file in a folder, or below it, that looks complete and is not, and why; empty: there is none.
std::string damage_in(const std::filesystem::path& folder);

}  // namespace sandstroke
