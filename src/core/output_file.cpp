#include "core/output_file.h"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>

#include "core/error.h"

namespace sandstroke {
namespace fs = std::filesystem;

fs::path part_path(const fs::path& path) {
  fs::path part = path;
  part += ".part";
  return part;
}

void finish_part(const fs::path& path) {
  std::error_code failure;
  fs::rename(part_path(path), path, failure);
  if (failure) {
    throw_io_error("{}: cannot be put in place ({}); the complete result is in {}", path.string(),
                   failure.message(), part_path(path).string());
  }
}

void write_text_file(const fs::path& path, std::string_view text) {
  const fs::path part = part_path(path);
  std::ofstream file(part, std::ios::binary);
  file << text;
  file.close();
  if (!file) {
    const std::string reason = std::strerror(errno);
    std::error_code ignored;
    fs::remove(part, ignored);
    throw_io_error("{}: cannot be written ({}); choose another place or free disk space", path.string(),
                   reason);
  }
  finish_part(path);
}

std::string read_text_file(const fs::path& path) {
  if (fs::is_directory(path)) throw_io_error("{}: is a folder; name a file", path.string());
  std::ifstream file(path, std::ios::binary);
  if (!file) throw_io_error("{}: cannot be opened ({}); check the path", path.string(), std::strerror(errno));
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

}  // namespace sandstroke
