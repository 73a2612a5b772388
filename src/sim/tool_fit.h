#pragma once

#include <limits>
#include <string>

#include "sim/scene.h"

namespace sandstroke {

// A tool must fit its bed, and its cells must resolve it. Both are told before a run begins. A mesh that was
// not read is not looked at.

/// The key of the settings that makes a tool's narrowest part wider, such as "tool.radius".
const char* width_key(const ToolSettings& tool);

/// Error: input, if the tool does not fit the bed, or if it is narrower (narrowest_width) than two cells, as
/// a sphere, eight, as a rake, or three, as any other tool: it would leave a furrow that depends on where the
/// cells lie, or none. depth [m]: what counts is the tool up to there. `name`: the file that the error names.
void check_tool_fits(const Scene& scene, const std::string& name,
                     double depth = std::numeric_limits<double>::infinity());

/// How far the furrow of a tool may be off whose narrowest width is so many cells, as a fraction (measured:
/// src/validation/README.md).
double expected_furrow_error(ToolShape shape, double cells);
/// A warning if the tool is wide enough, but narrower than ten cells; otherwise empty. depth [m]: of the
/// stroke.
std::string coarse_tool_warning(const Scene& scene, double depth);
/// A warning if sand would run off a tool that carries it because its walls are thinner than cells; otherwise
/// empty. Error: input, as UpperSide.
std::string leaking_tool_warning(const Scene& scene);

}  // namespace sandstroke
