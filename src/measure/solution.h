#pragma once

#include "sim/simulation.h"

namespace sandstroke {

/// The outcome of a scene, in memory.
struct Solution {
  HeightField surface;
  RunResult result;
};

/// Runs a scene from this surface, and measures the furrow that is left. Error: as Simulation.
Solution solve(const Scene& scene, const HeightField& start, const std::optional<Stroke>& stroke = {},
               Observers observers = {}, const Checkpoints& checkpoints = {});

}  // namespace sandstroke
