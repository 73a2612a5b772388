#pragma once

#include <filesystem>

namespace sandstroke {

/// A file system of so many kilobytes, mounted on a folder where only this process and those it starts see
/// it; gone with this object.
class SmallDisk {
 public:
  SmallDisk(std::filesystem::path folder, long kilobytes);
  SmallDisk(const SmallDisk&) = delete;
  ~SmallDisk();

  /// False where the system allows no mounts.
  bool mounted() const { return mounted_; }
  void resize(long kilobytes);
  void set_read_only(bool read_only);

 private:
  std::filesystem::path folder_;
  long kilobytes_;
  bool mounted_ = false;
};

/// Lets this process mount what others do not see. False: it may not.
bool have_own_mounts();

}  // namespace sandstroke
