#pragma once

#include <string>

namespace sandstroke {

/// The option of `stroke convert` for a key: "--position-unit".
std::string option_of(const std::string& key);
/// A key and its option of `stroke convert`, for messages: "stroke.table.rate (stroke convert: --rate)".
std::string option_and_key(const std::string& key);

}  // namespace sandstroke
