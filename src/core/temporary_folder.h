#pragma once

#include <filesystem>
#include <string>

namespace sandstroke {

/// A new, empty folder. The destructor removes it and all that is in it. Error: io.
class TemporaryFolder {
 public:
  TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  ~TemporaryFolder();

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

 private:
  std::filesystem::path path_;
};

}  // namespace sandstroke
