#include "import/sample_files.h"

namespace sandstroke {

std::string samples_name(const std::filesystem::path& path) {
  return path == "-" ? "standard input" : path.string();
}

std::vector<std::filesystem::path> sample_files(const std::filesystem::path& path,
                                                const TableSettings& settings) {
  std::vector<std::filesystem::path> files;
  if (path != "-") files.push_back(path);
  if (!settings.merge.empty()) files.push_back(path.parent_path() / settings.merge);
  return files;
}

}  // namespace sandstroke
