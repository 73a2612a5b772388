#pragma once

#include <optional>
#include <string>

#include "core/key_visitor.h"
#include "sand/ground_settings.h"

namespace sandstroke {

/// Shows [sand.map].
void describe_sand_map(KeyVisitor& visitor, std::optional<SandMap>& map);

/// Error: input, naming the keys, for what can be told without its file; `name` is the scene's file.
void check_sand_map(const SandMap& map, const std::string& name);

}  // namespace sandstroke
