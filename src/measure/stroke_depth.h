#pragma once

#include <string>

#include "haptics/stroke.h"
#include "sand/height_field.h"
#include "sim/run_result.h"
#include "sim/scene.h"

namespace sandstroke {

/// The point where a stroke's tip lies deepest below the initial sand.
struct DeepestPoint {
  double depth = 0.0;  ///< m; 0: nowhere below the sand of the bed
  double time = 0.0;   ///< s
};

/// stroke: as place_stroke() returns it. Looks at its samples; those outside the bed do not count.
DeepestPoint deepest_point(const Scene& scene, const HeightField& bed, const Stroke& stroke);

/// Checks that the cells resolve the tool as deep as the stroke goes (check_tool_fits). Error: input, naming
/// the stroke by `name`.
void check_tool_in_stroke(const Scene& scene, const HeightField& bed, const Stroke& stroke,
                          const std::string& name);

/// A sentence for a tool that never touches the sand: how far it stayed away, and what to change.
std::string untouched_text(const Scene& scene, const RunResult& result);

/// A warning if the stroke goes over 20 tool radii deep, as when millimetres are given instead of metres.
/// Otherwise empty. `name` is the stroke's.
std::string depth_warning(const Scene& scene, const HeightField& bed, const Stroke& stroke,
                          const std::string& name);

}  // namespace sandstroke
