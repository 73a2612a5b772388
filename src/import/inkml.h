#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "import/sample_table.h"

namespace sandstroke {

/// Reads pen strokes in InkML (W3C 2011): the points of each trace, by the channels of traceFormat (X and Y
/// if there is none), also as first and second differences. X, Y, Z, T and F become x, y, z, time and
/// pressure; others keep their names; intermittent channels are left out. Units are those of the channels, or
/// of a resolution per cm or mm. As InkML defines them, x grows to the right and y downwards; y is negated,
/// so that it points up, and an axis whose orientation is "-ve" the other way round. A warning tells of
/// values beyond a channel's min and max. Time comes from T (ms if no unit is given), or from sampleRate and
/// the traces' timeOffset (ms). Each trace lifts at its end, unless the next one continues it. Traces with
/// the pen up are left out. Error: io; input.
SampleTable read_inkml(const std::filesystem::path& path);
/// The same from text; `name` stands for the file in messages.
SampleTable parse_inkml(std::string_view text, const std::string& name);

}  // namespace sandstroke
