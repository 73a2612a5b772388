#pragma once

#include <string>
#include <vector>

#include "haptics/stroke.h"
#include "sim/run_result.h"
#include "sim/scene.h"

namespace sandstroke {

/// A stroke through a bed of simulated grains, and what it left and felt: means over all beds
/// (tests/accuracy/grains, where the same numbers are tables). The tool, of R 10 mm, goes down, along x and
/// up again. Its depth counts from where it first touches the bed.
struct GrainStroke {
  std::string name;
  ToolShape shape;
  double depth;  ///< m, of the tool's lowest point
  double way;    ///< m, along x; 0: a plunge
  std::vector<double>
      change;          ///< m, of the height: means by the distance from the axis, in bins of grain_bin
  double against, up;  ///< N, of the grains on the tool, on the measured way; of a plunge, at its end
};
extern const std::vector<GrainStroke> grain_strokes;

inline constexpr double grain_bin = 0.002;  ///< m
/// m, from a drag's start: sections and forces are means over this way.
inline constexpr double grain_way_from = 0.020, grain_way_to = 0.037;

/// The grains' sand and tool on a flat bed, with so many cells per radius.
Scene grain_scene(const GrainStroke& stroke, ModelPreset preset, int cells_per_radius);

/// The hand's way through grain_scene(), whose sand lies at 0.
Stroke hand_of(const GrainStroke& stroke);

/// What the program makes of a stroke, measured as of the grains.
struct GrainReply {
  RunResult result;
  std::vector<double> change;
  double against, up;  ///< N, of force.law = "rft"; 0 of the paper's
};
GrainReply reply_to(const GrainStroke& stroke, const Scene& scene);

/// The difference of two sections over the grains' change, each bin by the area that it stands for.
double section_error(const std::vector<double>& change, const GrainStroke& grains);

/// The difference of the two forces over the grains' force.
double force_error(const GrainReply& reply, const GrainStroke& grains);

/// Of a section: the groove's area, both sides [m^2], and the height of its levee [m].
struct Groove {
  double area = 0.0, levee = 0.0;
};
Groove groove_of(const std::vector<double>& change);

}  // namespace sandstroke
