#include "compare/replace_folder.h"

#include <fcntl.h>

#include <cstdio>

#include "core/output_file.h"

namespace sandstroke {
namespace fs = std::filesystem;

namespace {

/// In two steps: for want of an old one, or of a file system that exchanges names.
void move_folder(const fs::path& made, const fs::path& place) {
  const fs::path old = part_path(fs::path(place) += ".old");
  if (fs::exists(fs::symlink_status(place))) {  // else the old one may be all there is
    fs::remove_all(old);
    fs::rename(place, old);
  }
  std::error_code failure;
  fs::rename(made, place, failure);
  if (failure) {
    if (fs::exists(old)) fs::rename(old, place);
    throw fs::filesystem_error("cannot be put in place", place, failure);
  }
  fs::remove_all(old);
}

}  // namespace

void replace_folder(const fs::path& made, const fs::path& place) {
  if (renameat2(AT_FDCWD, made.c_str(), AT_FDCWD, place.c_str(), RENAME_EXCHANGE) != 0)
    move_folder(made, place);
  sync_folder_of(place);
}

}  // namespace sandstroke
