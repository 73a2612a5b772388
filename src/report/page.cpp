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
SANDSTROKE_DECLARE_ASSET(gl);
SANDSTROKE_DECLARE_ASSET(sand);
SANDSTROKE_DECLARE_ASSET(sand_view);
SANDSTROKE_DECLARE_ASSET(sand_part);
SANDSTROKE_DECLARE_ASSET(sand_style);
SANDSTROKE_DECLARE_ASSET(sand_look);  // of picture
SANDSTROKE_DECLARE_ASSET(live);
SANDSTROKE_DECLARE_ASSET(live_style);

namespace sandstroke {
namespace {

/// The parts of a page that not all pages have.
struct PageAssets {
  std::vector<std::string_view> scripts, styles;
  bool charts = true, sand = false;
};

PageAssets assets_of(PageScript script) {
  const auto of_parts = [](std::string_view own) {
    return PageAssets{.scripts = {SANDSTROKE_ASSET(maps), SANDSTROKE_ASSET(curves),
                                  SANDSTROKE_ASSET(sand_part), SANDSTROKE_ASSET(parts), own},
                      .styles = {SANDSTROKE_ASSET(parts_style)},
                      .sand = true};
  };
  switch (script) {
    case PageScript::bench:
      return {{SANDSTROKE_ASSET(bench)}, {}};
    case PageScript::stress:
      return {{SANDSTROKE_ASSET(stress)}, {}};
    case PageScript::sweep:
      return {{SANDSTROKE_ASSET(sweep_charts), SANDSTROKE_ASSET(sweep_points), SANDSTROKE_ASSET(sweep)},
              {SANDSTROKE_ASSET(sweep_style)}};
    case PageScript::compare:
      return of_parts(SANDSTROKE_ASSET(compare));
    case PageScript::run:
      return of_parts(SANDSTROKE_ASSET(run));
    case PageScript::live:
      return {.scripts = {SANDSTROKE_ASSET(live)},
              .styles = {SANDSTROKE_ASSET(live_style)},
              .charts = false,
              .sand = true};
  }
  return {};
}

/// Appends the scripts of a page, in order.
void add_scripts(const PageAssets& own, std::string& page) {
  const auto add = [&page](std::string_view text) {
    page += "<script>\n";
    page += text;
    page += "\n</script>\n";
  };
  if (own.charts) add(SANDSTROKE_ASSET(charts));
  add(SANDSTROKE_ASSET(page));
  if (own.charts) add(SANDSTROKE_ASSET(plot));
  if (own.sand) {
    add(fmt::format("const sandLook = {};", nlohmann::json(SANDSTROKE_ASSET(sand_look)).dump()));
    add(SANDSTROKE_ASSET(gl));
    add(SANDSTROKE_ASSET(sand));
    add(SANDSTROKE_ASSET(sand_view));
  }
  for (const std::string_view text : own.scripts) add(text);
}

/// JSON that can stand inside a script element. "<" occurs only within strings, where an escape means the
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
  if (own.sand) page += SANDSTROKE_ASSET(sand_style);
  for (const std::string_view style : own.styles) page += style;
  page +=
      "</style>\n</head>\n<body>\n<main id=\"page\"></main>\n<script type=\"application/json\" id=\"data\">";
  page += script_safe(data);
  page += "</script>\n";
  if (own.charts) {
    page += "<!-- The chart library's notice and licence:\n";
    page += SANDSTROKE_ASSET(charts_notice);
    page += SANDSTROKE_ASSET(charts_license);
    page += "-->\n";
  }
  add_scripts(own, page);
  page += "</body>\n</html>\n";
  return page;
}

nlohmann::ordered_json describe_machine() {
  return {{"cpu", cpu_name()},    {"cores", std::thread::hardware_concurrency()},
          {"compiler", compiler}, {"instruction_set", instruction_set()},
          {"version", version},   {"commit", commit}};
}

}  // namespace sandstroke
