#pragma once

#include <filesystem>
#include <functional>
#include <ostream>
#include <string>
#include <string_view>
#include <vector>

#include "core/file_lock.h"

// Where files lie. Read is what the command line names, and what such a file names, relative to where that
// lies; that must be a regular file, and of an HDF5 file nothing is read that lies in another. Written is
// only what the command line names, and beside it PATH.part, never through a link in its place. An output
// takes the place of a file only where that is empty, where this program wrote it as an output of the same
// kind, or where --overwrite says so. It keeps that file's mode.
namespace sandstroke {

/// A kind of output, and how a file is known to be one, also one that is cut off: by its first bytes, and by
/// a text in its first 64 KiB. Of a kind that has no first bytes none is known.
struct OutputKind {
  std::string_view name = {};  ///< "a run file"
  std::string_view begin = {}, mark = {};
  std::size_t header = 0;  ///< bytes: what begins so and has only zeros after these holds nothing yet
  bool kept = false;       ///< not even one of its own kind replaces it
  bool hdf5 = false;       ///< so no name of another format is its
  int version = 1;         ///< of the kind's format
};

/// The ending of a name in small letters: ".h5" of "A.H5".
std::string small_ending(const std::filesystem::path& path);
/// PATH ends in .h5 or .hdf5, also in capitals.
bool has_hdf5_name(const std::filesystem::path& path);

/// What --overwrite says, of all outputs: they replace any file.
void overwrite_outputs();

/// Refuses what an output of this kind must not replace, and a name of another format: an HDF5 file has a
/// name without an ending, too, and ".5" of "run-27.5" is none. Error: input; io, also of a link or a file
/// that is write-protected. A folder is not refused here.
void check_replaceable(const std::filesystem::path& path, const OutputKind& kind);

/// The name under which PATH is written until it is complete: PATH.part.
std::filesystem::path part_path(const std::filesystem::path& path);

/// The right to write PATH, by way of PATH.part, which is there from now on and has PATH's mode. Error: input
/// or io, where either must not be replaced, also where another process has it.
FileLock take_part(const std::filesystem::path& path, const OutputKind& kind);

/// Removes PATH.part, which holds nothing that is to be kept. Where it cannot, it stays: never an error.
void drop_part(const std::filesystem::path& path);

/// Refuses, before any work is done, an output that would destroy something or cannot be: one of the inputs
/// or other outputs, what check_replaceable() refuses, a folder, a device, in a folder that is not there or
/// read-only, or a name too long for PATH.part. Error: input or io.
void check_output(const std::filesystem::path& output, const std::vector<std::filesystem::path>& others,
                  const OutputKind& kind);

/// Makes a folder, and those above it, unless it is there. Error: io, if that fails or nothing can be written
/// in it.
void make_folder(const std::filesystem::path& folder);

/// PATH with its ending .h5 or .hdf5 replaced; any other name keeps its dots ("run-27.5").
std::filesystem::path beside(const std::filesystem::path& path, const std::string& ending);

/// So that a file's new name, too, survives a power failure, where the file system can do that.
void sync_folder_of(const std::filesystem::path& path);

/// Writes a complete PATH.part through to the disk and gives it its final name, for good. Error: io; input,
/// where somebody has put there what must not be replaced.
void finish_part(const std::filesystem::path& path, const OutputKind& kind);

/// Writes a whole file by way of PATH.part, so that PATH is either complete or untouched; without a kind it
/// replaces nothing. `write` writes all of it, or returns false: then nothing stays, and this is false, too.
/// Error: what `write` throws; input or io, as of take_part() and finish_part().
bool write_file(const std::filesystem::path& path, const OutputKind& kind,
                const std::function<bool(std::ostream&)>& write);

/// The same with text or any bytes that are there already.
void write_text_file(const std::filesystem::path& path, std::string_view text, const OutputKind& kind = {});

}  // namespace sandstroke
