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
/// Y. Otherwise Z is only the tool's height. M words lift a pen as GcodePen says; pen_up and pen_down name
/// them. Points with the pen up are left out, and the sample before them lifts. The path begins where the
/// first move ends. The position before it is not known; G91 and arcs take it as (0, 0, 0). On the way home
/// (G28, G30, G53) nothing is drawn, and the path goes on where the next move ends; the axes that went home
/// are at 0, and Z draws nothing until it is given again.
///
/// Words that do not change the path are passed over, also M words with X, Y and Z of their own (M201). The
/// program ends as GcodeProgram says. Warnings tell what is not followed, and where comments give other
/// bounds than the path. Error: io; input, naming file and line, also for words that change the path in other
/// ways, and where only the user knows what lifts the pen.
SampleTable read_gcode(const std::filesystem::path& path, const std::string& pen_up = "",
                       const std::string& pen_down = "");
/// The same from text; `name` stands for the file in messages.
SampleTable parse_gcode(std::string_view text, const std::string& name, const std::string& pen_up = "",
                        const std::string& pen_down = "");

/// How far the chords of an arc may be off it: Grbl's tolerance (its setting $12), and for large arcs this
/// fraction of the radius.
inline constexpr double gcode_arc_tolerance = 0.002;  // mm
inline constexpr double gcode_arc_fraction = 1e-5;

}  // namespace sandstroke
