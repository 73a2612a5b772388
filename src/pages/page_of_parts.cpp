#include "pages/page_of_parts.h"

#include "core/asset.h"
#include "core/error.h"
#include "report/page.h"

SANDSTROKE_DECLARE_ASSET(maps);
SANDSTROKE_DECLARE_ASSET(curves);
SANDSTROKE_DECLARE_ASSET(sand_part);
SANDSTROKE_DECLARE_ASSET(parts);
SANDSTROKE_DECLARE_ASSET(parts_style);

namespace sandstroke {

void PageOfParts::add_part(const std::string& name, const std::function<nlohmann::ordered_json()>& make) {
  try {
    if (nlohmann::ordered_json part = make(); !part.is_null()) data["parts"].push_back(std::move(part));
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::input) throw;
    data["missing"].push_back({{"name", name}, {"sentence", error.what()}});
  }
}

std::string PageOfParts::html() const {
  const PageAssets own{.scripts = {SANDSTROKE_ASSET(maps), SANDSTROKE_ASSET(curves),
                                   SANDSTROKE_ASSET(sand_part), SANDSTROKE_ASSET(parts), script},
                       .styles = {SANDSTROKE_ASSET(parts_style)},
                       .sand = true};
  return html_page(title, own, data);
}

}  // namespace sandstroke
