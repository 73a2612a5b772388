#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "import/sample_table.h"

namespace sandstroke {

/// Reads a track of a sand table (.thr): lines "theta rho", theta in rad, rho as a fraction of the table's
/// radius; "#" begins a comment. Gives x = rho sin(theta) and y = rho cos(theta) in the unit "radius", seen
/// from above: theta = 0 is up (the y axis), and theta grows clockwise (pi/2 is to the right), as in the
/// tables' own programs (Sisyphus' programming guide: theta = arctan(x / y); Sandify, ThetaRhoExporter:
/// atan2(x, y)). It turns on beyond 2 pi; rho below 0 is across the centre. Between two lines both change
/// evenly: the ball goes along Archimedean spirals. There is no time: tables go at a constant speed. Error:
/// io, input.
SampleTable read_thr(const std::filesystem::path& path);
/// The same from text; `name` stands for the file in messages.
SampleTable parse_thr(std::string_view text, const std::string& name);

/// How far the lines between the points may be off the spirals [radius].
inline constexpr double thr_tolerance = 1e-4;
/// How far the tip may be off the lines [radius]. The chords of a spiral have no corners then
/// (keep_lines_straight).
inline constexpr double thr_line_tolerance = 3e-4;

}  // namespace sandstroke
