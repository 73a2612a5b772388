#include "import/npz.h"

#include <vector>

#include "core/error.h"
#include "import/npy.h"
#include "import/zip_file.h"

namespace sandstroke {
namespace {

constexpr std::string_view ending = ".npy";

}  // namespace

SampleTable read_npz(const std::filesystem::path& path, const std::string& part) {
  const std::string file = path.string(), archive = whole_file(path);
  const auto size = static_cast<double>(archive.size());
  ArrayBudget budget(file, size), unpacked(file, size);  // entries may share one member's bytes
  std::vector<NamedArray> arrays;
  std::string why_not;
  for (const ZipMember& member : zip_members(archive, file)) {
    if (!member.name.ends_with(ending)) continue;
    const std::string name = member.name.substr(0, member.name.size() - ending.size());
    const std::string label = fmt::format("{}: {}", file, member.name);
    const std::string bytes = zip_unpacked(archive, member, unpacked.bytes_left(), file);
    unpacked.take(member.name, static_cast<double>(bytes.size()) / sizeof(double));
    NpyArray read = npy_array(bytes, name, label, budget);
    if (read.why_not.empty()) {
      arrays.push_back(std::move(read.array));
    } else if (name == part || why_not.empty()) {
      why_not = fmt::format("{} {}", member.name, read.why_not);
      if (name == part) throw_input_error("{}: {}", file, why_not);
    }
  }
  const std::string none =
      why_not.empty() ? "has no arrays; save some: numpy.savez('FILE', t=t, pos=pos)" : why_not;
  return table_of_arrays(std::move(arrays), part, file,
                         {"NumPy archive", "array", none.c_str(), "numpy.savez('FILE', a=a.T)"});
}

}  // namespace sandstroke
