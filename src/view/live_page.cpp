#include "view/live_page.h"

#include "core/asset.h"
#include "report/page.h"

SANDSTROKE_DECLARE_ASSET(live);
SANDSTROKE_DECLARE_ASSET(live_style);

namespace sandstroke {

std::string live_page(const std::string& title) {
  const PageAssets own{.scripts = {SANDSTROKE_ASSET(live)},
                       .styles = {SANDSTROKE_ASSET(live_style)},
                       .charts = false,
                       .sand = true};
  return html_page(title, own, {});
}

}  // namespace sandstroke
