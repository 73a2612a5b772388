#pragma once

#include <Eigen/Core>

#include "sand/tool_footprint.h"

namespace sandstroke {

/// Where pushed sand goes: the whole ring around the tool (as published), or the part of it ahead of the
/// motion.
enum class Deposit { ring, ahead };

struct DisplacementSettings {
  Deposit deposit = Deposit::ring;
};

/// The paper's two passes (3.1): takes the sand that stands above the tool's underside out of the bowl, and
/// heaps it on the ring in proportion to the positive filter. The footprint must have been placed on the bed
/// as it is now; it is used up. motion [m]: the tool's displacement during the tick (Deposit::ahead). Returns
/// the volume moved [m^3]; it is conserved to rounding. Where no ring cell lies inside the bed nothing is
/// displaced.
double displace(HeightField& bed, ToolFootprint& footprint, double tip_height, const Eigen::Vector3d& motion,
                const DisplacementSettings& settings);

}  // namespace sandstroke
