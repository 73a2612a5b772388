#pragma once

#include <string>

namespace sandstroke {

/// Text as XML takes it in elements and attributes. Control characters, which XML cannot carry, become '?'.
std::string xml_escaped(const std::string& text);

}  // namespace sandstroke
