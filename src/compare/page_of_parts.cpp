#include "compare/page_of_parts.h"

namespace sandstroke {

void PageOfParts::add_part(const std::string& name, const std::function<nlohmann::ordered_json()>& make) {
  try {
    if (nlohmann::ordered_json part = make(); !part.is_null()) data["parts"].push_back(std::move(part));
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::input) throw;
    data["missing"].push_back({{"name", name}, {"sentence", error.what()}});
  }
}

}  // namespace sandstroke
