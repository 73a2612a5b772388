#include "compare/tolerances.h"

#include <spdlog/fmt/fmt.h>

#include "io/toml_reader.h"

namespace sandstroke {
namespace {
constexpr const char* default_source = "default";
}

std::vector<UsedTolerance> used_tolerances(const GivenTolerances& options, const GivenTolerances& in_file,
                                           const std::filesystem::path& file) {
  std::vector<UsedTolerance> all;
  for (const ToleranceKey& key : tolerance_keys) {
    UsedTolerance& used = all.emplace_back(UsedTolerance{key, Tolerances().*key.value, default_source});
    if (const auto found = in_file.find(key.name); found != in_file.end()) {
      used.value = found->second;
      used.source = file.string();
    }
    if (const auto found = options.find(key.name); found != options.end()) {
      used.value = found->second;
      used.source = key.option;
    }
  }
  return all;
}

Tolerances values_of(const std::vector<UsedTolerance>& used) {
  Tolerances values;
  for (const UsedTolerance& one : used) values.*one.key.value = one.value;
  return values;
}

std::string changed_tolerances(const std::vector<UsedTolerance>& used) {
  std::vector<std::string> changed;
  for (const auto& [key, value, source] : used)
    if (source != default_source)
      changed.push_back(
          fmt::format("{} {}{}{} ({})", key.name, value, *key.unit ? " " : "", key.unit, source));
  return fmt::format("{}", fmt::join(changed, ", "));
}

GivenTolerances read_tolerances(const std::filesystem::path& file) {
  GivenTolerances given;
  if (!std::filesystem::exists(file)) return given;
  const TomlReader toml = TomlReader::from_file(file);
  for (const ToleranceKey& key : tolerance_keys)
    if (toml.has(key.name)) given[key.name] = toml.number(key.name, 0.0, key.golden_range(), key.unit);
  toml.reject_unread();
  return given;
}

}  // namespace sandstroke
