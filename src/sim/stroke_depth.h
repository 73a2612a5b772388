#pragma once

#include <string>

#include "haptics/stroke.h"
#include "sand/height_field.h"
#include "sim/run_result.h"
#include "sim/scene.h"

namespace sandstroke {

/// Where a stroke's tip lies deepest below the sand as it is at the start.
struct DeepestPlace {
  double depth = 0.0;  ///< m; 0: nowhere below the sand of the bed
  double time = 0.0;   ///< s
};

/// stroke: as place_stroke() leaves it. Looks at its samples; those outside the bed count for nothing.
DeepestPlace deepest_place(const Scene& scene, const HeightField& bed, const Stroke& stroke);

/// Where on the bed a stroke draws, and what brings it there: for whoever draws elsewhere.
std::string way_onto_the_bed(const Stroke& stroke, const Scene& scene);

/// A sentence for whoever sees the tool never touch the sand: how far it stayed away, and what mends it.
std::string untouched_text(const Scene& scene, const RunResult& result);

/// A sentence for whoever gave millimetres where metres are meant: the stroke goes over 20 tool radii deep.
/// Empty: it does not. `name` is the stroke's.
std::string depth_warning(const Scene& scene, const HeightField& bed, const Stroke& stroke,
                          const std::string& name);

}  // namespace sandstroke
