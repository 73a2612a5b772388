#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "import/sample_table.h"

namespace sandstroke {

/// Reads a plot in HPGL: PU and PD, absolute (PA) and relative (PR), arcs (AA, AR), circles (CI) and outlines
/// of rectangles (EA, ER). Gives x and y in mm, y up; a plotter's unit is 1/40 mm. What does not change the
/// path is passed over (IN, SP, VS, escape sequences). Warnings tell of labels and filled areas, which are
/// not drawn. There is no time: a speed gives it. Error: io; input, naming file and line, also for what would
/// scale or turn the plot (SC, RO), and for encoded lines (PE) and polygons (PM).
SampleTable read_hpgl(const std::filesystem::path& path);
/// The same from text; `name` stands for the file in messages.
SampleTable parse_hpgl(std::string_view text, const std::string& name);

/// True if a text begins as HPGL does, and moves a pen.
bool looks_like_hpgl(std::string_view text);

}  // namespace sandstroke
