#pragma once

#include <filesystem>
#include <optional>
#include <utility>

namespace sandstroke {

/// True if the name still means this open file: nobody renamed, removed or replaced it.
bool still_named(int descriptor, const std::filesystem::path& path);

/// A lock on a file. It keeps out other processes, and other holders in this one. It ends with its holder,
/// however that ends. On a file system without locks it keeps nobody out, and warns once.
class FileLock {
 public:
  /// Creates the file if it is missing. None: somebody holds the lock. Error: io, also if the name belongs to
  /// something other than a regular file, such as a link.
  static std::optional<FileLock> try_take(const std::filesystem::path& path);
  /// The same, for a file that others lock only for a moment: waits for them.
  static FileLock wait_and_take(const std::filesystem::path& path);
  /// Shares the lock with others that only read the file, which must exist. None: somebody holds it alone.
  /// Error: io.
  static std::optional<FileLock> try_share(const std::filesystem::path& path);
  FileLock(FileLock&& other) noexcept;
  FileLock& operator=(FileLock&& other) noexcept {
    std::swap(descriptor_, other.descriptor_);
    return *this;
  }
  ~FileLock();

 private:
  explicit FileLock(int descriptor) : descriptor_(descriptor) {}
  static std::optional<FileLock> take(const std::filesystem::path& path, int how);
  /// False: somebody holds it.
  bool lock(const std::filesystem::path& path, short type, int how);

  int descriptor_;
};

}  // namespace sandstroke
