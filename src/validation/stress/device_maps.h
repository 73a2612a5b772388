#pragma once

#include "validation/stress/loop_map.h"

namespace sandstroke {

/// Where the device loop is stable, swings or diverges, over pairs of its settings.
std::vector<LoopMapPlan> device_map_plans(bool quick);

}  // namespace sandstroke
