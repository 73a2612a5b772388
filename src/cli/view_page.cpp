#include "cli/view_page.h"

#include "report/page.h"

namespace sandstroke {

std::string view_page(const std::string& title) {
  return html_page(title, PageScript::live, nlohmann::ordered_json::object());
}

}  // namespace sandstroke
