#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "compare/run_checks.h"

namespace sandstroke {

/// The traces of golden and run as a part of a page: force on the device (its magnitude and components),
/// depth and sand level, each with the difference run - golden over the ticks that both have (of the
/// magnitude: the length of the difference), and the force that was recorded with the run's stroke, where it
/// was. A trace that is missing has no curves. Only what trace_difference looks at is used else.
nlohmann::ordered_json traces_part(const std::optional<std::vector<TickRecord>>& golden,
                                   const std::optional<std::vector<TickRecord>>& run,
                                   const Tolerances& tolerances);

/// The same of one run, the energy that its device gave to the sand, and how well its force agrees with the
/// recorded one.
nlohmann::ordered_json traces_part(const std::vector<TickRecord>& trace);

/// J, given to the sand up to each tick: EnergyAccount over the positions that the trace holds (a dynamic
/// device's are as its encoders read them).
std::vector<double> absorbed_energy(const std::vector<TickRecord>& trace);

}  // namespace sandstroke
