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
  struct flock whole_file {};
  whole_file.l_type = F_WRLCK;
  whole_file.l_whence = SEEK_SET;
  // Bound to this descriptor: others of the same process may open and close the file on their own.
  if (fcntl(taken.descriptor_, F_OFD_SETLK, &whole_file) < 0) return std::nullopt;
  return taken;
}

FileLock::FileLock(FileLock&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}

FileLock::~FileLock() {
  if (descriptor_ >= 0) close(descriptor_);
}

}  // namespace sandstroke
