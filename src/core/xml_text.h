#pragma once

#include <string>
#include <string_view>

namespace sandstroke {

/// Text as XML takes it in elements and attributes. What XML cannot carry becomes '?': control characters,
/// and bytes that are no UTF-8, as names of files may have.
std::string xml_escaped(std::string_view text);

}  // namespace sandstroke
