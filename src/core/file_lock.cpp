#include "core/file_lock.h"

#include <fcntl.h>
#include <spdlog/spdlog.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <mutex>

#include "core/error.h"

namespace sandstroke {

bool still_named(int descriptor, const std::filesystem::path& path) {
  struct stat open_file {};
  struct stat named {};
  return fstat(descriptor, &open_file) == 0 && stat(path.c_str(), &named) == 0 &&
         open_file.st_dev == named.st_dev && open_file.st_ino == named.st_ino;
}

std::optional<FileLock> FileLock::try_take(const std::filesystem::path& path) {
  return take(path, F_OFD_SETLK);
}

FileLock FileLock::wait_and_take(const std::filesystem::path& path) {
  std::optional<FileLock> taken = take(path, F_OFD_SETLKW);
  if (!taken) throw_io_error("{}: cannot be locked; choose another place", path.string());
  return std::move(*taken);
}

std::optional<FileLock> FileLock::take(const std::filesystem::path& path, int how) {
  // Tries again if the last holder renamed or removed the file between open and lock: it is then another
  // file.
  while (true) {
    FileLock taken(open(path.c_str(), O_CREAT | O_RDWR | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK, 0666));
    if (taken.descriptor_ < 0 && errno == ELOOP)
      throw_io_error("{}: is a link, and sandstroke does not write through links; remove it", path.string());
    if (taken.descriptor_ < 0)
      throw_io_error("{}: cannot be written ({}); choose another place or free disk space", path.string(),
                     std::strerror(errno));
    struct stat opened {};
    if (fstat(taken.descriptor_, &opened) != 0 || !S_ISREG(opened.st_mode))
      throw_io_error("{}: is not a regular file; remove it or choose another place", path.string());
    if (!taken.lock(path, F_WRLCK, how)) return std::nullopt;
    if (still_named(taken.descriptor_, path)) return taken;
  }
}

std::optional<FileLock> FileLock::try_share(const std::filesystem::path& path) {
  FileLock shared(open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (shared.descriptor_ < 0)
    throw_io_error("{}: cannot be opened ({}); check the path", path.string(), std::strerror(errno));
  if (!shared.lock(path, F_RDLCK, F_OFD_SETLK)) return std::nullopt;
  return shared;
}

bool FileLock::lock(const std::filesystem::path& path, short type, int how) {
  struct flock whole_file {};
  whole_file.l_type = type;
  whole_file.l_whence = SEEK_SET;
  // The lock belongs to this descriptor: others in the same process may open and close the file.
  int result;
  do result = fcntl(descriptor_, how, &whole_file);
  while (result != 0 && errno == EINTR);
  if (result == 0) return true;
  const int error = errno;
  if (error == EAGAIN || error == EACCES) return false;
  // Errors of NFS, Lustre and others that are mounted without locks. Users must be able to work there, too.
  if (error != ENOLCK && error != EOPNOTSUPP && error != EINVAL && error != ENOSYS)
    throw_io_error("{}: cannot be locked ({}); choose another place", path.string(), std::strerror(error));
  if (type == F_RDLCK) return true;  // it only reads
  static std::once_flag told;
  std::call_once(told, [&] {
    spdlog::warn(
        "{}: this file system has no locks ({}), so two commands could write the same file; give each "
        "command its own output",
        path.string(), std::strerror(error));
  });
  return true;
}

FileLock::FileLock(FileLock&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}

FileLock::~FileLock() {
  if (descriptor_ >= 0) close(descriptor_);
}

}  // namespace sandstroke
