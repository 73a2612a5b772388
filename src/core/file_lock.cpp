#include "core/file_lock.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "core/error.h"

namespace sandstroke {

std::optional<FileLock> FileLock::try_take(const std::filesystem::path& path) {
  FileLock taken(open(path.c_str(), O_CREAT | O_RDWR | O_CLOEXEC, 0666));
  if (taken.descriptor_ < 0)
    throw_io_error("{}: cannot be written ({}); choose another place", path.string(), std::strerror(errno));
  if (!taken.lock(F_WRLCK)) return std::nullopt;
  return taken;
}

std::optional<FileLock> FileLock::try_share(const std::filesystem::path& path) {
  FileLock shared(open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (shared.descriptor_ < 0)
    throw_io_error("{}: cannot be opened ({}); check the path", path.string(), std::strerror(errno));
  if (!shared.lock(F_RDLCK)) return std::nullopt;
  return shared;
}

bool FileLock::lock(short type) {
  struct flock whole_file {};
  whole_file.l_type = type;
  whole_file.l_whence = SEEK_SET;
  // Bound to this descriptor: others of the same process may open and close the file on their own.
  return fcntl(descriptor_, F_OFD_SETLK, &whole_file) == 0;
}

FileLock::FileLock(FileLock&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}

FileLock::~FileLock() {
  if (descriptor_ >= 0) close(descriptor_);
}

}  // namespace sandstroke
