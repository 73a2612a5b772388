#include "compare/replace_folder.h"

#include <fcntl.h>

#include <cstdio>

#include "core/output_file.h"

namespace sandstroke {
namespace fs = std::filesystem;

namespace {

/// Moves the folder in two steps: for the case that there is no old one, or names cannot be exchanged.
void move_folder(const fs::path& made, const fs::path& place) {
  const fs::path old = part_path(fs::path(place) += ".old");
  if (fs::exists(fs::symlink_status(place))) {  // if not, `old` may be the only entry
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
