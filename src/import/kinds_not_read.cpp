#include "import/kinds_not_read.h"

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

}  // namespace

const std::span<const KindNotRead> packed_kinds = kinds_of_archives;

void refuse_kinds(std::span<const KindNotRead> kinds, const std::filesystem::path& path,
                  std::string_view head) {
  const std::string ending = small_ending(path);
  for (const KindNotRead& kind : kinds)
    if (head.starts_with(kind.begin) && (kind.ending.empty() || ending == kind.ending))
      throw_input_error("{}: is {}, which sandstroke cannot read; {}", path.string(), kind.name,
                        kind.way_out);
}

}  // namespace sandstroke
