#pragma once

#include <pybind11/pybind11.h>

namespace sandstroke {

// The parts of the module that have files of their own.

/// Adds Tick, and _Simulation, which wraps SteppedSimulation.
void add_stepped(pybind11::module_& module);

/// Adds _step_many, which steps many _Simulations at once.
void add_step_many(pybind11::module_& module);

/// Adds _bench and _stress: they test laws that are Python functions, as `sandstroke bench --plugin` and
/// `stress --plugin` test plugin laws.
void add_judging(pybind11::module_& module);

}  // namespace sandstroke
