#include "compare/scene_difference.h"

#include <spdlog/fmt/fmt.h>

#include "io/toml_reader.h"

namespace sandstroke {

std::string scene_difference(const std::string& golden, const std::string& run) {
  const TomlReader before = TomlReader::from_text(golden, "the golden scene"),
                   after = TomlReader::from_text(run, "the run's scene");
  std::vector<std::string> changes;
  for (const std::string& key : before.keys_in("")) {
    const std::string was = before.literal(key), is = after.literal(key);
    if (was != is)
      changes.push_back(is.empty() ? fmt::format("{} was {}, is gone", key, was)
                                   : fmt::format("{} was {}, is {}", key, was, is));
  }
  for (const std::string& key : after.keys_in(""))
    if (!before.has(key)) changes.push_back(fmt::format("{} is new, {}", key, after.literal(key)));
  return fmt::format("{}", fmt::join(changes, "; "));
}

}  // namespace sandstroke
