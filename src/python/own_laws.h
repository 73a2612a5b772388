#pragma once

#include <pybind11/pybind11.h>

#include "python/kept_run.h"

namespace sandstroke {

/// The scene with laws that are Python functions, for trying out: laws has "relaxation", "displacement" or
/// "force". They are called with the interpreter held, which a run lets go otherwise. Error: input, where
/// another name is given, or what is no function.
SceneHere with_python_laws(SceneHere here, const pybind11::dict& laws);

}  // namespace sandstroke
