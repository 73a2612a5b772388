#include "report/page.h"

#include <spdlog/fmt/fmt.h>

#include <thread>
#include <vector>

#include "core/machine.h"
#include "core/version.h"
#include "core/xml_text.h"
#include "sand/instruction_set.h"

// Embedded by assets.S.
#define SANDSTROKE_ASSET(name)                     \
  extern "C" const char sandstroke_asset_##name[]; \
  extern "C" const char sandstroke_asset_##name##_end[]
SANDSTROKE_ASSET(charts);
SANDSTROKE_ASSET(charts_license);
SANDSTROKE_ASSET(charts_notice);
SANDSTROKE_ASSET(style);
SANDSTROKE_ASSET(page);
SANDSTROKE_ASSET(plot);
SANDSTROKE_ASSET(bench);
SANDSTROKE_ASSET(stress);
SANDSTROKE_ASSET(sweep_charts);
SANDSTROKE_ASSET(sweep_points);
SANDSTROKE_ASSET(sweep);
SANDSTROKE_ASSET(sweep_style);
SANDSTROKE_ASSET(compare_maps);
SANDSTROKE_ASSET(compare_traces);
SANDSTROKE_ASSET(compare);
SANDSTROKE_ASSET(compare_style);
#undef SANDSTROKE_ASSET

namespace sandstroke {
namespace {

std::string_view between(const char* begin, const char* end) {
  return {begin, static_cast<std::size_t>(end - begin)};
}
#define SANDSTROKE_ASSET(name) between(sandstroke_asset_##name, sandstroke_asset_##name##_end)

/// What a page has of its own.
struct PageAssets {
  std::vector<std::string_view> scripts;
  std::string_view style;
};

PageAssets assets_of(PageScript script) {
  switch (script) {
    case PageScript::bench:
      return {{SANDSTROKE_ASSET(bench)}, {}};
    case PageScript::stress:
      return {{SANDSTROKE_ASSET(stress)}, {}};
    case PageScript::sweep:
      return {{SANDSTROKE_ASSET(sweep_charts), SANDSTROKE_ASSET(sweep_points), SANDSTROKE_ASSET(sweep)},
              SANDSTROKE_ASSET(sweep_style)};
    case PageScript::compare:
      return {{SANDSTROKE_ASSET(compare_maps), SANDSTROKE_ASSET(compare_traces), SANDSTROKE_ASSET(compare)},
              SANDSTROKE_ASSET(compare_style)};
  }
  return {};
}

/// JSON that can stand inside a script element: "<" only occurs within strings, where an escape says the
/// same.
std::string script_safe(const nlohmann::ordered_json& data) {
  std::string safe;
  for (const char c : data.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace))
    c == '<' ? safe += "\\u003c" : safe += c;
  return safe;
}

}  // namespace

std::string html_page(std::string_view title, PageScript script, const nlohmann::ordered_json& data) {
  const PageAssets own = assets_of(script);
  const std::string name = xml_escaped(std::string(title));
  std::string page = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, "
      "initial-scale=1\">\n<title>{}</title>\n<style>\n",
      name);
  page += SANDSTROKE_ASSET(style);
  page += own.style;
  page +=
      "</style>\n</head>\n<body>\n<main id=\"page\"></main>\n<script type=\"application/json\" id=\"data\">";
  page += script_safe(data);
  page += "</script>\n<!-- The chart library's notice and licence:\n";
  page += SANDSTROKE_ASSET(charts_notice);
  page += SANDSTROKE_ASSET(charts_license);
  page += "-->\n";
  std::vector<std::string_view> texts = own.scripts;
  texts.insert(texts.begin(), {SANDSTROKE_ASSET(charts), SANDSTROKE_ASSET(page), SANDSTROKE_ASSET(plot)});
  for (const std::string_view text : texts) {
    page += "<script>\n";
    page += text;
    page += "\n</script>\n";
  }
  page += "</body>\n</html>\n";
  return page;
}

nlohmann::ordered_json describe_machine() {
  return {{"cpu", cpu_name()},    {"cores", std::thread::hardware_concurrency()},
          {"compiler", compiler}, {"instruction_set", instruction_set()},
          {"version", version},   {"commit", commit}};
}

}  // namespace sandstroke
