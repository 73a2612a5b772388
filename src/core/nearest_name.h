#pragma once

#include <set>
#include <string>

namespace sandstroke {

/// The known name that an unknown one most likely means: one that continues `name` (within the same part of a
/// dotted key), else those with the same last part ("a.x or b.x"), else the one with the fewest edits. Empty:
/// no name is near, or `name` itself is known.
std::string nearest_name(const std::string& name, const std::set<std::string>& known);

}  // namespace sandstroke
