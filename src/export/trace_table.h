#pragma once

#include <vector>

#include "io/table.h"
#include "sim/run_result.h"

namespace sandstroke {

/// A table of a trace is known by its first columns.
inline constexpr OutputKind trace_output{"a run's trace", "time [s],hand_position_x [m],",
                                         ",passivity_margin [N s/m],"};

/// A trace as a table: a row per tick, a column per number of visit_tick_fields(), named with its unit:
/// "depth [m]", "device_force_x [N]". Flags are 0 or 1. content: the columns of this run that not every run
/// has.
Table trace_table(const std::vector<TickRecord>& ticks, const TraceContent& content = {});

}  // namespace sandstroke
