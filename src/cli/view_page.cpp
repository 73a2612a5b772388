#include "cli/view_page.h"

namespace sandstroke {

std::string view_page(const std::string&) {
  return "<!DOCTYPE html>\n<title>sandstroke</title>\n<p>The sand goes here.</p>\n";
}

}  // namespace sandstroke
