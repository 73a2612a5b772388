#include "report/page.h"

#include <spdlog/fmt/fmt.h>

#include <thread>
#include <vector>

#include "core/asset.h"
#include "core/machine.h"
#include "core/version.h"
#include "core/xml_text.h"
#include "sand/instruction_set.h"

// Embedded by assets.S.
SANDSTROKE_DECLARE_ASSET(charts);
SANDSTROKE_DECLARE_ASSET(charts_license);
SANDSTROKE_DECLARE_ASSET(charts_notice);
SANDSTROKE_DECLARE_ASSET(style);
SANDSTROKE_DECLARE_ASSET(page);
SANDSTROKE_DECLARE_ASSET(plot);
SANDSTROKE_DECLARE_ASSET(bench);
SANDSTROKE_DECLARE_ASSET(stress);
SANDSTROKE_DECLARE_ASSET(sweep_charts);
SANDSTROKE_DECLARE_ASSET(sweep_points);
SANDSTROKE_DECLARE_ASSET(sweep);
SANDSTROKE_DECLARE_ASSET(sweep_style);
SANDSTROKE_DECLARE_ASSET(maps);
SANDSTROKE_DECLARE_ASSET(curves);
SANDSTROKE_DECLARE_ASSET(parts);
SANDSTROKE_DECLARE_ASSET(parts_style);
SANDSTROKE_DECLARE_ASSET(compare);
SANDSTROKE_DECLARE_ASSET(run);

namespace sandstroke {
namespace {

/// What a page has of its own.
struct PageAssets {
  std::vector<std::string_view> scripts;
  std::string_view style;
};

PageAssets assets_of(PageScript script) {
  const auto of_parts = [](std::string_view own) {
    return PageAssets{{SANDSTROKE_ASSET(maps), SANDSTROKE_ASSET(curves), SANDSTROKE_ASSET(parts), own},
                      SANDSTROKE_ASSET(parts_style)};
  };
  switch (script) {
    case PageScript::bench:
      return {{SANDSTROKE_ASSET(bench)}, {}};
    case PageScript::stress:
      return {{SANDSTROKE_ASSET(stress)}, {}};
    case PageScript::sweep:
      return {{SANDSTROKE_ASSET(sweep_charts), SANDSTROKE_ASSET(sweep_points), SANDSTROKE_ASSET(sweep)},
              SANDSTROKE_ASSET(sweep_style)};
    case PageScript::compare:
      return of_parts(SANDSTROKE_ASSET(compare));
    case PageScript::run:
      return of_parts(SANDSTROKE_ASSET(run));
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
  const std::string name = xml_escaped(title);
  std::string page = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, "
      "initial-scale=1\">\n<meta name=\"generator\" content=\"{}\">\n<title>{}</title>\n<style>\n",
      xml_escaped(build), name);
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
