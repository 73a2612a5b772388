#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "core/output_file.h"

namespace sandstroke {

/// The scripts of a page: page.js, which all pages share, and its own. live: sand while it is shaped, from
/// the server that the page came from; it has no charts.
enum class PageScript { bench, stress, sweep, compare, run, live };

/// The generator tells a page from other files.
inline constexpr OutputKind page_output{"a page", "<!DOCTYPE html>\n",
                                        "<meta name=\"generator\" content=\"sandstroke "};

/// One self-contained HTML page: style, chart library (with its licence), scripts and data are embedded, so
/// it needs no network. Text in `data` may come from anywhere: it cannot end the page's script element, and
/// the scripts put it into the page as text only.
std::string html_page(std::string_view title, PageScript script, const nlohmann::ordered_json& data);

/// The machine and the build that measured: cpu, cores, compiler, instruction_set, version, commit.
nlohmann::ordered_json describe_machine();

}  // namespace sandstroke
