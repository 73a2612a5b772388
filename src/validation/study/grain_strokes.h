#pragma once

#include <string>
#include <vector>

#include "haptics/stroke.h"
#include "sim/run_result.h"
#include "sim/scene.h"

namespace sandstroke {

/// A stroke through simulated grains, with the surface that it left and the force: means over all beds
/// (tables in tests/accuracy/grains). The tool (R 10 mm) goes down, along x and up again, and through the air
/// back for its next pass. Its depth counts from the first touch of the bed.
struct GrainStroke {
  std::string name;
  ToolShape shape;
  double depth;                ///< m, depth of the tool's lowest point
  double way;                  ///< m, length of the drag along x; 0: a plunge
  int passes;                  ///< through the same furrow; forces are the last one's
  std::vector<double> change;  ///< m, mean height change by distance from the axis, in bins of grain_bin
  double against, up;          ///< N, force on the tool: mean over the measured part, or at a plunge's end
};
extern const std::vector<GrainStroke> grain_strokes;

inline constexpr double grain_bin = 0.002;  ///< m
/// The measured part of a drag [m, from its start]. Sections and forces are means over it.
inline constexpr double grain_way_from = 0.020, grain_way_to = 0.037;

/// The program's scene for the grains' sand and tool, on a flat bed.
Scene grain_scene(const GrainStroke& stroke, ModelPreset preset, int cells_per_radius);

/// The stroke through grain_scene(), whose sand lies at z = 0.
Stroke hand_of(const GrainStroke& stroke);

/// The program's result for a stroke, measured in the same way as the grains'.
struct GrainReply {
  RunResult result;
  std::vector<double> change;
  double against, up;  ///< N, by force.law = "rft"; 0 by the paper's law
};
GrainReply reply_to(const GrainStroke& stroke, const Scene& scene);

/// The sum of the sections' differences over the grains' change. Each bin is weighted by its area.
double section_error(const std::vector<double>& change, const GrainStroke& grains);

/// The difference of the two forces, divided by the grains' force.
double force_error(const GrainReply& reply, const GrainStroke& grains);

/// A section's groove area, both sides [m^2], and the height of its levee [m].
struct Groove {
  double area = 0.0, levee = 0.0;
};
Groove groove_of(const std::vector<double>& change);

}  // namespace sandstroke
