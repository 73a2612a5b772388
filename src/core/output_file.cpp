#include "core/output_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>

#include "core/error.h"

namespace sandstroke {
namespace fs = std::filesystem;

fs::path part_path(const fs::path& path) {
  fs::path part = path;
  part += ".part";
  return part;
}

FileLock take_part(const fs::path& path) {
  std::optional<FileLock> lock = FileLock::try_take(part_path(path));
  if (!lock)
    throw_io_error("{}: another process is writing this file; wait for it, or choose another name",
                   path.string());
  return std::move(*lock);
}

void drop_part(const fs::path& path) {
  std::error_code ignored;
  fs::remove(part_path(path), ignored);
}

namespace {

fs::path folder_of(const fs::path& path) {
  return path.has_parent_path() ? path.parent_path() : fs::path(".");
}

void check_takes_files(const fs::path& folder) {
  if (access(folder.c_str(), W_OK) != 0)
    throw_io_error("{}: nothing can be written in this folder ({}); choose another", folder.string(),
                   std::strerror(errno));
}

}  // namespace

void check_output(const fs::path& output, const std::vector<fs::path>& others) {
  const auto place = [](const fs::path& path) { return fs::weakly_canonical(fs::absolute(path)); };
  for (const fs::path& other : others) {
    std::error_code not_there;
    if (place(output) == place(other) || fs::equivalent(output, other, not_there))
      throw_input_error("{}: is named twice in this command; give the output another name", output.string());
  }
  if (fs::is_directory(output)) throw_io_error("{}: is a folder; name a file", output.string());
  if (fs::exists(output) && !fs::is_regular_file(output))
    throw_io_error("{}: is not a regular file; name one", output.string());
  const fs::path folder = folder_of(output);
  if (!fs::is_directory(folder))
    throw_io_error("{}: cannot be written, because the folder {} does not exist; make it first",
                   output.string(), folder.string());
  check_takes_files(folder);
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
  if (path.extension() == ".h5" || path.extension() == ".hdf5") result.replace_extension();
  return result += ending;
}

void sync_folder_of(const fs::path& path) {
  const int descriptor = open(folder_of(path).c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;
  fsync(descriptor);
  close(descriptor);
}

void finish_part(const fs::path& path) {
  const fs::path part = part_path(path);
  // On the disk before it has its name: after a power failure, too, a file of that name is complete.
  const int file = open(part.c_str(), O_RDONLY | O_CLOEXEC);
  const bool safe = file >= 0 && fsync(file) == 0;
  const std::string reason = std::strerror(errno);
  if (file >= 0) close(file);
  if (!safe)
    throw_io_error("{}: cannot be written ({}); free disk space or choose another place", path.string(),
                   reason);
  std::error_code failure;
  fs::rename(part, path, failure);
  if (failure) {
    throw_io_error("{}: cannot be put in place ({}); the complete result is in {}", path.string(),
                   failure.message(), part.string());
  }
  sync_folder_of(path);
}

void write_text_file(const fs::path& path, std::string_view text) {
  const FileLock lock = take_part(path);
  std::ofstream file(part_path(path), std::ios::binary);
  file << text;
  file.close();
  if (!file) {
    const std::string reason = std::strerror(errno);
    drop_part(path);
    throw_io_error("{}: cannot be written ({}); choose another place or free disk space", path.string(),
                   reason);
  }
  finish_part(path);
}

}  // namespace sandstroke
