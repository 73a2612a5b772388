#pragma once

#include <filesystem>
#include <optional>
#include <utility>

namespace sandstroke {

/// Whether the name still means this open file: nobody renamed, removed or replaced it.
bool still_named(int descriptor, const std::filesystem::path& path);

/// Keeps other processes, and other holders in this one, from what a file stands for; gone with its holder,
/// however that ends. On a file system without locks it keeps nobody from anything, and warns once.
class FileLock {
 public:
  /// Makes the file where it is not there. None: somebody holds it. Error: io; also where something else than
  /// a file has its name, as a link to one that nobody meant.
  static std::optional<FileLock> try_take(const std::filesystem::path& path);
  /// The same, of a file that others may be looking at for a moment: waits for them.
  static FileLock wait_and_take(const std::filesystem::path& path);
  /// With others that only read the file, which is there. None: somebody has taken it. Error: io.
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
