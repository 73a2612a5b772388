#pragma once

#include <filesystem>
#include <functional>
#include <ostream>
#include <string>
#include <string_view>
#include <vector>

#include "core/file_lock.h"

// Which files this program reads and writes. It reads only what the command line names, and what such a file
// names, relative to that file's folder. These must be regular files, and an HDF5 file may not refer to data
// in another file. It writes only what the command line names, and PATH.part beside it, never through a link.
// An output replaces a file only if that is empty, if this program wrote it as an output of the same kind, or
// with --overwrite. The output keeps that file's mode.
namespace sandstroke {

/// A kind of output. A file of this kind, even a cut-off one, is known by its first bytes, and by a text in
/// its first 64 KiB. Without first bytes a kind is never known.
struct OutputKind {
  std::string_view name = {};  ///< "a run file"
  std::string_view begin = {}, mark = {};
  std::size_t header = 0;  ///< bytes; a file with only zeros behind them holds nothing yet
  bool kept = false;       ///< not even an output of its own kind replaces it
  bool hdf5 = false;       ///< names of other formats are refused
  int version = 1;         ///< of the format
};

/// The kind, of which no output is replaced, not even by its own kind.
constexpr OutputKind irreplaceable(OutputKind kind) {
  kind.kept = true;
  return kind;
}

/// The ending of a name in small letters: ".h5" for "A.H5".
std::string small_ending(const std::filesystem::path& path);
/// True if PATH ends in .h5 or .hdf5, in small or capital letters.
bool has_hdf5_name(const std::filesystem::path& path);

/// Lets all outputs replace any file, as --overwrite says.
void overwrite_outputs();

/// Refuses what an output of this kind must not replace, and a name of another format. An HDF5 file may have
/// a name without an ending, and ".5" in "run-27.5" is none. Error: input; io, also for a link or a
/// write-protected file. It does not refuse a folder.
void check_replaceable(const std::filesystem::path& path, const OutputKind& kind);

/// The name under which PATH is written until it is complete: PATH.part.
std::filesystem::path part_path(const std::filesystem::path& path);

/// Takes the right to write PATH. From now on PATH.part exists and has PATH's mode. Error: input or io, if
/// either must not be replaced, or if another process is writing PATH.
FileLock take_part(const std::filesystem::path& path, const OutputKind& kind);

/// Removes PATH.part, which holds nothing worth keeping. If it cannot be removed, it stays: never an error.
void drop_part(const std::filesystem::path& path);

/// Refuses, before any work is done, an output that would destroy something or cannot be written: one of the
/// inputs or other outputs, what check_replaceable() refuses, a folder, a device, a file in a missing or
/// read-only folder, or a name too long for PATH.part. Error: input or io.
void check_output(const std::filesystem::path& output, const std::vector<std::filesystem::path>& others,
                  const OutputKind& kind);

/// Makes a folder, and those above it, if it is missing. Error: io, if that fails or nothing can be written
/// in it.
void make_folder(const std::filesystem::path& folder);

/// PATH with `ending` in place of .h5 or .hdf5. Any other name keeps its dots ("run-27.5").
std::filesystem::path beside(const std::filesystem::path& path, const std::string& ending);

/// Makes a file's new name, too, survive a power failure, if the file system can do that.
void sync_folder_of(const std::filesystem::path& path);

/// Writes PATH.part, as it is, through to the disk. Error: io.
void sync_part(const std::filesystem::path& path);

/// Error: io, if another process is writing PATH.part.
void check_part_is_free(const std::filesystem::path& path);

/// Writes a complete PATH.part through to the disk and renames it to PATH. Error: io; input, if somebody has
/// put a file there that must not be replaced.
void finish_part(const std::filesystem::path& path, const OutputKind& kind);

/// Writes a whole file by way of PATH.part, so that PATH is either complete or untouched. Without a kind it
/// replaces nothing. `write` writes all of it, or returns false: then no file stays, and this returns false,
/// too. Error: what `write` throws; input or io, as in take_part() and finish_part().
bool write_file(const std::filesystem::path& path, const OutputKind& kind,
                const std::function<bool(std::ostream&)>& write);

/// The same for text or bytes that are in memory.
void write_text_file(const std::filesystem::path& path, std::string_view text, const OutputKind& kind = {});

}  // namespace sandstroke
