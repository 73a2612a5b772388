#pragma once

#include <string>
#include <string_view>

namespace sandstroke {

/// Escapes text for XML elements and attributes. What XML cannot carry becomes '?': control characters, and
/// bytes that are not UTF-8, which names of files may have.
std::string xml_escaped(std::string_view text);

}  // namespace sandstroke
