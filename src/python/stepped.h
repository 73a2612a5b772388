#pragma once

#include <pybind11/pybind11.h>

namespace sandstroke {

/// Adds Tick, and _Simulation, which wraps SteppedSimulation.
void add_stepped(pybind11::module_& module);

}  // namespace sandstroke
