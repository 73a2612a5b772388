#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/file_lock.h"

// Where files lie. Read is what the command line names, and what such a file names, relative to where that
// lies; that must be a regular file, and of an HDF5 file nothing is read that lies in another. Written is
// only what the command line names, and beside it PATH.part, never through a link in its place.
namespace sandstroke {

/// The name under which PATH is written until it is complete: PATH.part.
std::filesystem::path part_path(const std::filesystem::path& path);

/// The right to write PATH, by way of PATH.part, which is there from now on. Error: io, also where another
/// process has it.
FileLock take_part(const std::filesystem::path& path);

/// Removes PATH.part, which holds nothing that is to be kept. Where it cannot, it stays: never an error.
void drop_part(const std::filesystem::path& path);

/// Refuses, before any work is done, an output that would destroy something or cannot be: one of the inputs
/// or other outputs, a folder, a device, or in a folder that is not there or read-only. Error: input or io.
void check_output(const std::filesystem::path& output, const std::vector<std::filesystem::path>& others);

/// Makes a folder, and those above it, unless it is there. Error: io, if that fails or nothing can be written
/// in it.
void make_folder(const std::filesystem::path& folder);

/// PATH with its ending .h5 or .hdf5 replaced; any other name keeps its dots ("run-27.5").
std::filesystem::path beside(const std::filesystem::path& path, const std::string& ending);

/// So that a file's new name, too, survives a power failure, where the file system can do that.
void sync_folder_of(const std::filesystem::path& path);

/// Writes a complete PATH.part through to the disk and gives it its final name, for good. Error: io.
void finish_part(const std::filesystem::path& path);

/// Writes a whole file, of text or any bytes, by way of PATH.part, so that PATH is either complete or
/// untouched. Error: io, also where another process is writing it.
void write_text_file(const std::filesystem::path& path, std::string_view text);

}  // namespace sandstroke
