#pragma once

#include <pybind11/pybind11.h>

namespace sandstroke {

/// Adds _bench and _stress: they test laws that are Python functions, as `sandstroke bench --plugin` and
/// `stress --plugin` test plugin laws.
void add_judging(pybind11::module_& module);

}  // namespace sandstroke
