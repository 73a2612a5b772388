#pragma once

#include <pybind11/pybind11.h>

namespace sandstroke {

/// Tick, and _Simulation: SteppedSimulation.
void add_stepped(pybind11::module_& module);

}  // namespace sandstroke
