#pragma once

#include "sim/scene.h"

namespace sandstroke {

/// How stiff sand is to a tool, where the law of the force is of the contact and the sand's strength is
/// limited to max_force [N, above 0] (Wrench::limited) [N/m, of the bed]: the largest singular value of how
/// the force changes with the tool's way, over ways of a twentieth of force.yield, 20 um at most. Taken on
/// level sand at the depth where its strength reaches max_force (or of the whole tool), for 400 directions in
/// which the tool may have yielded, and, where `turns`, for some ways to hold it. An estimate: what lies
/// between the directions may be some 10 % stiffer. It depends on the cells, of which the tool's surface is
/// made.
double contact_stiffness(const Scene& scene, double max_force, bool turns = false);

}  // namespace sandstroke
