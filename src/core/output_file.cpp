#include "core/output_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>

#include "core/error.h"
#include "core/input_file.h"
#include "core/small_letters.h"

namespace sandstroke {
namespace fs = std::filesystem;

namespace {

bool overwrite = false;

/// True if this program wrote the file as an output of this kind, or if it holds nothing.
bool is_own(const fs::path& path, const OutputKind& kind) {
  if (!fs::exists(fs::symlink_status(path))) return true;  // somebody may have removed it
  const std::string text = beginning_of(path, 64 * 1024);
  if (text.empty()) return true;
  return !kind.begin.empty() && text.starts_with(kind.begin) &&
         (text.find_first_not_of('\0', kind.header) == std::string::npos ||
          text.find(kind.mark) != std::string::npos);
}

/// Refuses a name that others would take for another format.
void check_name(const fs::path& path, const OutputKind& kind) {
  const std::string ending = path.extension().string();
  if (kind.hdf5 && !has_hdf5_name(path) && ending.find_first_not_of(".0123456789") != std::string::npos)
    throw_input_error("{}: {} is an HDF5 file; give it a name that ends with .h5", path.string(), kind.name);
}

void refuse(const fs::path& path, const OutputKind& kind) {
  throw_input_error(
      "{}: already exists{}; name another file, or add --overwrite", path.string(),
      kind.begin.empty() || kind.kept ? "" : fmt::format(" and is not {} that sandstroke wrote", kind.name));
}

/// Refuses what no output replaces. True: a regular file is there, and --overwrite is not given.
bool check_path(const fs::path& path) {
  const fs::file_status there = fs::symlink_status(path);
  if (!fs::exists(there) || fs::is_directory(there)) return false;
  if (fs::is_symlink(there))
    throw_io_error("{}: is a link, and sandstroke does not write through links; remove it", path.string());
  if (!fs::is_regular_file(there))
    throw_io_error("{}: is not a regular file; remove it or choose another place", path.string());
  // Not access(): root may write everything, and a folder's owner may replace what is in it.
  if ((there.permissions() & fs::perms::owner_write) == fs::perms::none)
    throw_io_error("{}: is write-protected; allow writing (chmod u+w), or name another file", path.string());
  return !overwrite;
}

void check_part_replaceable(const fs::path& path, const OutputKind& kind) {
  const fs::path part = part_path(path);
  if (check_path(part) && !is_own(part, kind)) refuse(part, kind);
}

}  // namespace

void overwrite_outputs() { overwrite = true; }

std::string small_ending(const fs::path& path) { return small_letters(path.extension().string()); }

bool has_hdf5_name(const fs::path& path) {
  const std::string ending = small_ending(path);
  return ending == ".h5" || ending == ".hdf5";
}

void check_replaceable(const fs::path& path, const OutputKind& kind) {
  check_name(path, kind);
  if (check_path(path) && (kind.kept || !is_own(path, kind))) refuse(path, kind);
}

fs::path part_path(const fs::path& path) {
  fs::path part = path;
  part += ".part";
  return part;
}

namespace {

[[noreturn]] void refuse_second_writer(const fs::path& path) {
  throw_io_error("{}: another process is writing this file; wait for it, or choose another name",
                 path.string());
}

}  // namespace

void check_part_is_free(const fs::path& path) {
  const fs::path part = part_path(path);
  if (fs::is_regular_file(fs::symlink_status(part)) && !FileLock::try_take(part)) refuse_second_writer(path);
}

FileLock take_part(const fs::path& path, const OutputKind& kind) {
  check_replaceable(path, kind);
  const fs::path part = part_path(path);
  std::optional<FileLock> lock = FileLock::try_take(part);
  if (!lock) refuse_second_writer(path);
  check_part_replaceable(path, kind);
  std::error_code not_there, ignored;  // some file systems have no modes
  const fs::file_status replaced = fs::symlink_status(path, not_there);
  if (fs::is_regular_file(replaced)) fs::permissions(part, replaced.permissions(), ignored);
  return std::move(*lock);
}

void drop_part(const fs::path& path) {
  std::error_code ignored;
  fs::remove(part_path(path), ignored);
}

namespace {

fs::path folder_to_write(const fs::path& path) {
  return path.has_parent_path() ? path.parent_path() : fs::path(".");
}

void check_takes_files(const fs::path& folder) {
  if (access(folder.c_str(), W_OK) != 0)
    throw_io_error("{}: nothing can be written in this folder ({}); choose another", folder.string(),
                   std::strerror(errno));
}

}  // namespace

void check_output(const fs::path& output, const std::vector<fs::path>& others, const OutputKind& kind) {
  const auto absolute = [](const fs::path& path) {
    std::error_code of_a_pipe;  // /dev/stdin and what a shell makes of <(command) are links to no path
    const fs::path whole = fs::absolute(path), real = fs::weakly_canonical(whole, of_a_pipe);
    return of_a_pipe ? whole : real;
  };
  for (const fs::path& other : others)
    for (const fs::path& written : {output, part_path(output)}) {
      std::error_code not_there;
      if (absolute(written) == absolute(other) || fs::equivalent(written, other, not_there))
        throw_input_error("{}: is named twice in this command; give the output another name",
                          written.string());
    }
  if (fs::is_directory(output)) throw_io_error("{}: is a folder; name a file", output.string());
  if (fs::exists(output) && !fs::is_regular_file(output))
    throw_io_error("{}: is not a regular file; name a regular file", output.string());
  const fs::path folder = folder_to_write(output);
  if (!fs::is_directory(folder))
    throw_io_error("{}: cannot be written, because the folder {} does not exist; make it first",
                   output.string(), folder.string());
  check_takes_files(folder);
  check_replaceable(output, kind);
  check_part_replaceable(output, kind);
}

void make_folder(const fs::path& folder) {
  std::error_code failure;
  fs::create_directories(folder, failure);
  if (failure)
    throw_io_error("{}: this folder cannot be made ({}); choose another", folder.string(), failure.message());
  check_takes_files(folder);
}

fs::path beside(const fs::path& path, const std::string& ending) {
  fs::path result = path;
  if (has_hdf5_name(path)) result.replace_extension();
  return result += ending;
}

void sync_folder_of(const fs::path& path) {
  const int descriptor = open(folder_to_write(path).c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;
  fsync(descriptor);
  close(descriptor);
}

void sync_part(const fs::path& path) {
  const int file = open(part_path(path).c_str(), O_RDONLY | O_CLOEXEC);
  const bool safe = file >= 0 && fsync(file) == 0;
  const std::string reason = std::strerror(errno);
  if (file >= 0) close(file);
  if (!safe)
    throw_io_error("{}: cannot be written ({}); free disk space or choose another place", path.string(),
                   reason);
}

void finish_part(const fs::path& path, const OutputKind& kind) {
  const fs::path part = part_path(path);
  sync_part(path);                // before it gets its name: then it is complete even after a power failure
  check_replaceable(path, kind);  // again: a file may have come there since
  std::error_code failure;
  fs::rename(part, path, failure);
  if (failure) {
    throw_io_error("{}: cannot be put in place ({}); the complete result is in {}", path.string(),
                   failure.message(), part.string());
  }
  sync_folder_of(path);
}

bool write_file(const fs::path& path, const OutputKind& kind,
                const std::function<bool(std::ostream&)>& write) {
  const FileLock lock = take_part(path, kind);
  std::ofstream file(part_path(path), std::ios::binary);
  try {
    if (!write(file)) {
      drop_part(path);
      return false;
    }
  } catch (...) {
    drop_part(path);
    throw;
  }
  file.close();
  if (!file) {
    const std::string reason = std::strerror(errno);
    drop_part(path);
    throw_io_error("{}: cannot be written ({}); choose another place or free disk space", path.string(),
                   reason);
  }
  finish_part(path, kind);
  return true;
}

void write_text_file(const fs::path& path, std::string_view text, const OutputKind& kind) {
  write_file(path, kind, [&](std::ostream& file) {
    file << text;
    return true;
  });
}

}  // namespace sandstroke
