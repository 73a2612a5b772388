#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "import/sample_table.h"

namespace sandstroke {

/// Reads G-code of sand tables, plotters and engravers (RS-274, as Grbl and Marlin take it): G0 to G3, arcs
/// by I and J or by R, G17, G20/G21, G90/G91, G90.1/G91.1, G92, in lower or upper case, several words in a
/// line, motion that stays in force, comments, line numbers and checksums. Gives x and y in mm, z if the file
/// moves it, and time if the file gives a speed (F; G0 counts as equally fast).
///
/// If Z only moves by itself, the pen is down where Z is below 0, or at the lowest Z of any move along X or
/// Y. Otherwise Z is only the tool's height. If the file has M3 or M4, the pen is also up after M5, at S0,
/// and in G0. A pen on a servo (M280, or M300 with an angle) is up after the word that pen_up names ("M280
/// S90"), and down after that M word with other numbers; only its user knows which angle is up. Points with
/// the pen up are left out, and the sample before them lifts. The path begins where the first move ends. The
/// position before it is not known; G91 and arcs take it as (0, 0, 0). Words that do not move the tool along
/// a path are passed over (M words, tools, dwelling, G28: going home). Error: io; input, naming file and
/// line.
SampleTable read_gcode(const std::filesystem::path& path, const std::string& pen_up = "");
/// The same from text; `name` stands for the file in messages.
SampleTable parse_gcode(std::string_view text, const std::string& name, const std::string& pen_up = "");

/// How far the chords of an arc may be off it: Grbl's tolerance (its setting $12), and for large arcs this
/// fraction of the radius.
inline constexpr double gcode_arc_tolerance = 0.002;  // mm
inline constexpr double gcode_arc_fraction = 1e-5;

}  // namespace sandstroke
