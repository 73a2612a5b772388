#include "core/temporary_folder.h"

#include <stdlib.h>

#include <cerrno>
#include <cstring>

#include "core/error.h"

namespace sandstroke {
namespace fs = std::filesystem;

TemporaryFolder::TemporaryFolder() {
  std::error_code failure;
  const fs::path parent = fs::temp_directory_path(failure);
  if (failure) throw_io_error("TMPDIR is not a folder ({}); set it to a writable folder", failure.message());
  std::string name = (parent / "sandstroke-XXXXXX").string();
  if (!mkdtemp(name.data()))
    throw_io_error("{}: this temporary folder cannot be made ({}); set TMPDIR to another place", name,
                   std::strerror(errno));
  path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

}  // namespace sandstroke
