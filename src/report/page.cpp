#include "report/page.h"

#include <spdlog/fmt/fmt.h>

#include <thread>

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
SANDSTROKE_DECLARE_ASSET(gl);
SANDSTROKE_DECLARE_ASSET(sand);
SANDSTROKE_DECLARE_ASSET(sand_view);
SANDSTROKE_DECLARE_ASSET(sand_style);
SANDSTROKE_DECLARE_ASSET(sand_look);  // of picture

namespace sandstroke {
namespace {

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

std::string html_page(std::string_view title, const PageAssets& own, const nlohmann::ordered_json& data) {
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
