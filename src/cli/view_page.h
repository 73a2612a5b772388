#pragma once

#include <string>

namespace sandstroke {

/// The page that shows a view live: one self-contained HTML text.
std::string view_page(const std::string& title);

}  // namespace sandstroke
