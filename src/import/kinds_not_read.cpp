#include "import/kinds_not_read.h"

#include <cctype>

#include "core/error.h"
#include "core/output_file.h"

namespace sandstroke {
namespace {

constexpr const char* unpack = "unpack it and name the file inside";
constexpr KindNotRead kinds_of_archives[] = {
    {"PK\x03\x04", "", "a zip archive", unpack},
    {"\x1F\x8B", "", "packed by gzip", "unpack it: gunzip FILE"},
    {"BZh", "", "packed by bzip2", "unpack it: bunzip2 FILE"},
    {"\xFD"
     "7zXZ",
     "", "packed by xz", "unpack it: unxz FILE"},
    {"\x28\xB5\x2F\xFD", "", "packed by zstd", "unpack it: unzstd FILE"},
    {"7z\xBC\xAF", "", "a 7z archive", unpack},
};

constexpr KindNotRead kinds_of_pointers[] = {
    {"version https://git-lfs.github.com/spec/", "", "a pointer of Git LFS and not the file itself",
     "get the file: git lfs pull"},
    {"/annex/objects/", "", "a pointer of git-annex and not the file itself",
     "get the file: git annex get FILE"},
};

bool begins_with(std::string_view head, const KindNotRead& kind) {
  if (!head.starts_with(kind.begin)) return false;
  const std::string_view next = head.substr(kind.begin.size(), 1);
  return !kind.is_binary || (!next.empty() && std::iscntrl(static_cast<unsigned char>(next[0])) &&
                             std::isspace(static_cast<unsigned char>(next[0])) == 0);
}

}  // namespace

const std::span<const KindNotRead> packed_kinds = kinds_of_archives;
const std::span<const KindNotRead> pointer_kinds = kinds_of_pointers;

void refuse_kinds(std::span<const KindNotRead> kinds, const std::filesystem::path& path,
                  std::string_view head) {
  const std::string ending = small_ending(path);
  for (const KindNotRead& kind : kinds)
    if (begins_with(head, kind) && (kind.ending.empty() || ending == kind.ending))
      throw_input_error("{}: is {}, which sandstroke cannot read; {}", path.string(), kind.name,
                        kind.way_out);
}

}  // namespace sandstroke
