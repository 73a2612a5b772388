#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "compare/run_checks.h"

namespace sandstroke {

/// A part of a page with the traces of golden and run: force on the device (its magnitude and components),
/// depth and sand level. Each has the difference run - golden over the ticks that both have; that of the
/// magnitude is the length of the difference. The force recorded with the run's stroke is shown, if there is
/// one. A trace that is missing has no curves. Otherwise the part uses only what trace_difference reads.
nlohmann::ordered_json traces_part(const std::optional<std::vector<TickRecord>>& golden,
                                   const std::optional<std::vector<TickRecord>>& run,
                                   const Tolerances& tolerances);

/// The same for one run, with the energy that its device gave to the sand, and how well its force agrees with
/// the recorded one.
nlohmann::ordered_json traces_part(const std::vector<TickRecord>& trace);

/// The energy given to the sand up to each tick [J]: EnergyAccount over the positions in the trace. Positions
/// of a dynamic device are as its encoders read them.
std::vector<double> absorbed_energy(const std::vector<TickRecord>& trace);

}  // namespace sandstroke
