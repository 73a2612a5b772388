#include "io/state_file.h"

#include <algorithm>
#include <sstream>

#include "core/error.h"
#include "core/version.h"

namespace sandstroke {

std::string state_head(const OutputKind& kind) {
  return std::string(kind.begin) + std::string(version) + "\n";
}

std::string_view after_state_head(std::string_view bytes, const OutputKind& kind, const std::string& name) {
  if (!bytes.starts_with(kind.begin)) throw_input_error("{}: this is not {}", name, kind.name);
  bytes.remove_prefix(kind.begin.size());
  const std::string_view its_version = bytes.substr(0, std::min(bytes.find('\n'), bytes.size()));
  if (its_version != version)
    throw_input_error("{}: a state is read only by the version that kept it, {}; this is {}", name,
                      its_version, version);
  return bytes.substr(std::min(its_version.size() + 1, bytes.size()));
}

std::string scene_difference(const std::string& here, const std::string& kept, std::string_view what) {
  std::istringstream ours(here), theirs(kept);
  while (true) {
    std::string our, their;
    const bool more = static_cast<bool>(std::getline(ours, our)),
               others = static_cast<bool>(std::getline(theirs, their));
    if (!more && !others) return "";
    if (!more) our = "nothing";
    if (!others) their = "nothing";
    if (our != their) return fmt::format("it has {}, this {} {}", their, what, our);
  }
}

}  // namespace sandstroke
