#pragma once

#include <vector>

#include "validation/stress/device_loop.h"

namespace sandstroke {

/// Loops that differ in all there is: servo rate 50 Hz to 20 kHz, mass, damping, hand, scale, delay of 0 to
/// 20 ticks, k_c and depth; walls and sand, with and without drag along z. No force limit, exact encoders, no
/// dropped ticks; the gain is to be chosen. The same in every run.
std::vector<LoopSettings> varied_loops(int count);

/// The gain up to which Colgate & Schenkel's condition holds (passivity_margin).
double passive_gain(const LoopSettings& settings);

/// Stiffness felt at the measured, the exact and the passive gain.
Boundary boundary_of(const LoopSettings& settings);

}  // namespace sandstroke
