#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "import/sample_table.h"

namespace sandstroke {

/// G-code of sand tables, plotters and engravers (RS-274, as Grbl and Marlin take it): G0 to G3, arcs by I
/// and J or by R, G17, G20/G21, G90/G91, G90.1/G91.1, G92, in lower or upper case, several words in a line,
/// motion that stays in force, comments, line numbers and checksums. Gives x and y in mm, z where the file
/// moves it, and time where it says a speed (F; G0 is taken to be as fast).
///
/// The pen is down where Z is below 0, or at the lowest Z at which anything moves, if Z moves by itself only;
/// else Z is the tool's height and nothing more. Where there is M3 or M4, the pen is also up after M5, at S0,
/// and in G0. A pen on a servo (M280, or M300 with an angle) is up after the word that pen_up names ("M280
/// S90"), down after others; which angle is up only its user knows. Points of a pen that is up are left out,
/// and the sample before them lifts. The path begins where the first move ends; before it, nothing is known
/// but for G91 and arcs: (0, 0, 0). What else does not move the tool along a path is passed over (M words,
/// tools, dwelling, G28: going home). Error: io; input, naming file and line.
SampleTable read_gcode(const std::filesystem::path& path, const std::string& pen_up = "");
/// The same from text; `name` stands for the file in messages.
SampleTable parse_gcode(std::string_view text, const std::string& name, const std::string& pen_up = "");

/// How far lines may be off the arc that they stand for: Grbl's (its setting $12), and for large arcs this
/// share of the radius.
inline constexpr double gcode_arc_tolerance = 0.002;  // mm
inline constexpr double gcode_arc_share = 1e-5;

}  // namespace sandstroke
