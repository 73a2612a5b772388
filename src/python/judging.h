#pragma once

#include <pybind11/pybind11.h>

namespace sandstroke {

/// _bench and _stress: what `sandstroke bench --plugin` and `stress --plugin` do with a plugin's laws, for
/// laws that are Python functions.
void add_judging(pybind11::module_& module);

}  // namespace sandstroke
