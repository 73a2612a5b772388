#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "core/output_file.h"

namespace sandstroke {

/// The scripts and styles of a page, beside the frame that all pages share.
struct PageAssets {
  std::vector<std::string_view> scripts = {}, styles = {};  ///< its own
  bool charts = true;                                       ///< the chart library
  bool sand = false;                                        ///< sand in 3-D
};

/// The generator tells a page from other files.
inline constexpr OutputKind page_output{"a page", "<!DOCTYPE html>\n",
                                        "<meta name=\"generator\" content=\"sandstroke "};

/// One self-contained HTML page: style, chart library (with its licence), scripts and data are embedded, so
/// it needs no network. Text in `data` may come from anywhere: it cannot end the page's script element, and
/// the scripts put it into the page as text only.
std::string html_page(std::string_view title, const PageAssets& own, const nlohmann::ordered_json& data);

/// The machine and the build that measured: cpu, cores, compiler, instruction_set, version, commit.
nlohmann::ordered_json describe_machine();

}  // namespace sandstroke
