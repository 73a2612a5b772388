#pragma once

#include <string>

namespace sandstroke {

/// The page that shows sand while it is shaped, from the server that the page came from, as HTML.
std::string live_page(const std::string& title);

}  // namespace sandstroke
