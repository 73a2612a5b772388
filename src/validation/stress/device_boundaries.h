#pragma once

#include <vector>

#include "validation/stress/device_loop.h"

namespace sandstroke {

/// Makes loops that differ in every setting: servo rate (50 Hz to 20 kHz), mass, damping, hand, scale, delay
/// (0 to 20 ticks), k_c and depth; walls and sand, with and without drag along z. They have no force limit,
/// exact encoders and no dropped ticks. The caller chooses the gain. Every run gives the same loops.
std::vector<LoopSettings> varied_loops(int count);

/// The gain up to which Colgate & Schenkel's condition holds (passivity_margin).
double passive_gain(const LoopSettings& settings);

/// Computes the stiffness felt at the measured, the exact and the passive gain.
Boundary boundary_of(const LoopSettings& settings);

}  // namespace sandstroke
