#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "import/sample_table.h"

namespace sandstroke {

/// Reads pen strokes in UNIPEN (Guyon et al. 1994): rows of .COORD's columns (X Y if there is none) after
/// .PEN_DOWN and .PEN_UP. All other keywords and their text are passed over. Gives x and y in mm if the file
/// gives points per inch or mm; time from T (ms), or from .POINTS_PER_SECOND and .DT; the other columns by
/// their names. y is taken to point up, as it stands; the description says so, because the format does not.
/// Rows with the pen up take time and are left out: the sample before them lifts. Error: io; input, naming
/// file and line.
SampleTable read_unipen(const std::filesystem::path& path);
/// The same from text; `name` stands for the file in messages.
SampleTable parse_unipen(std::string_view text, const std::string& name);

/// True if a line begins with .PEN_DOWN or .COORD.
bool looks_like_unipen(std::string_view text);

}  // namespace sandstroke
