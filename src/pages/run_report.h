#pragma once

#include <functional>
#include <optional>

#include "io/run_file.h"
#include "pages/page_of_parts.h"
#include "picture/image.h"

namespace sandstroke {

/// A page on one run: its figures, a picture (which `draw` makes of the last surface), force, depth and
/// energy over time, profiles of the sand along and across the stroke, the error estimate, the scene's
/// settings and the file's provenance. If the run was cut off, or has no stroke or no trace, the page shows
/// what there is and says why the rest is missing. Error: io; input, where the file holds no surface.
PageOfParts run_report(const RunFile& run, const std::function<Image(const LastSurface&)>& draw,
                       const std::optional<ErrorEstimate>& error);

}  // namespace sandstroke
