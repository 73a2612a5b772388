#include "import/xml_parts.h"

#include <algorithm>

#include "core/error.h"

namespace sandstroke {

void parse_xml(std::string_view text, const std::string& name, pugi::xml_document& document) {
  const pugi::xml_parse_result result = document.load_buffer(text.data(), text.size());
  if (result) return;
  const auto until = text.begin() + std::min<std::ptrdiff_t>(result.offset, std::ssize(text));
  throw_input_error("{}:{}: is not valid XML ({}); save the file again", name,
                    1 + std::count(text.begin(), until, '\n'), result.description());
}

}  // namespace sandstroke
