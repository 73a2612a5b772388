#pragma once

#include "tool/tool_settings.h"

namespace sandstroke {

/// The width [m] of a tool's narrowest part: of a plate its thickness, of a rake its teeth, of a sphere its
/// diameter. Neither a sphere nor a rake's round teeth become narrower in shallow sand: there the cells
/// resolve them better. Level planes up to `depth` [m] above the lowest point cut any other tool into
/// outlines. The narrowest outline of a plane counts, and of all planes the one where that is widest: a cone
/// is as wide as where it enters the sand. An outline is as wide as the closest two lines that have it
/// between them. A wall that is bent to a tube or an angle counts as up to twice its width. Error: input,
/// where a mesh was not read.
double narrowest_width(const ToolSettings& tool, double depth);

/// The same of any closed surface, already turned.
double narrowest_width(const TriangleMesh& surface, double depth);

}  // namespace sandstroke
