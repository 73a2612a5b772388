#pragma once

#include <set>
#include <string>

namespace sandstroke {

/// The known name that was most likely meant by one that is not known: one that goes on where `name` ends
/// (within the same part of a dotted key); those with the same last part ("a.x or b.x"); or the one with the
/// fewest edits. Empty: none is near, or the name itself is known.
std::string nearest_name(const std::string& name, const std::set<std::string>& known);

}  // namespace sandstroke
