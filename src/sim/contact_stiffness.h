#pragma once

#include "sim/scene.h"

namespace sandstroke {

/// How stiff sand is, at most, to a tool in any direction and depth, where force.law is not the paper's and
/// the sand's strength is limited to max_force [N, above 0] (Wrench::limited) [N/m, of the bed]: the largest
/// singular value of how the force changes with the tool's way, over ways of a twentieth of force.yield, 20
/// um at most. Taken on level sand at the depth where its strength reaches max_force (or of the whole tool),
/// for 26 directions in which the tool may have yielded.
double contact_stiffness(const Scene& scene, double max_force);

}  // namespace sandstroke
