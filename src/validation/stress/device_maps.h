#pragma once

#include "validation/stress/loop_map.h"

namespace sandstroke {

/// Plans maps that show, over pairs of settings, where the device loop is stable, swings or diverges.
std::vector<LoopMapPlan> device_map_plans(bool quick);

}  // namespace sandstroke
