#pragma once

#include "sim/scene.h"

namespace sandstroke {

/// How stiff sand is to a tool [N/m, of the bed], if the force comes from the contact and the sand's strength
/// is limited to max_force [N, above 0] (Wrench::limited). The force grows by no more than that per way of
/// the tool (ElasticWrench). It is taken on level sand at the depth where the strength reaches max_force (or
/// of the whole tool), as the largest for 400 directions in which the tool may have yielded, and, if `turns`,
/// for some of its orientations. It depends on the cells, from which the tool's surface is made.
double contact_stiffness(const Scene& scene, double max_force, bool turns = false);

}  // namespace sandstroke
