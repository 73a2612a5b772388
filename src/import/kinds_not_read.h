#pragma once

#include <filesystem>
#include <span>
#include <string_view>

namespace sandstroke {

/// A kind of file that is not read, known by its first bytes, its ending, or both.
struct KindNotRead {
  std::string_view begin, ending;
  const char *name, *way_out;
  bool is_binary = false;  ///< the byte behind `begin` is no text, which a column's name would be
};

/// Files that hold others, whatever is in them.
extern const std::span<const KindNotRead> packed_kinds;

/// What Git keeps in the place of a file, whatever its ending.
extern const std::span<const KindNotRead> pointer_kinds;

/// Refuses a file of one of these kinds. head: its first bytes. Error: input, with the way out.
void refuse_kinds(std::span<const KindNotRead> kinds, const std::filesystem::path& path,
                  std::string_view head);

}  // namespace sandstroke
