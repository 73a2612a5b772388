#pragma once

#include <pybind11/pybind11.h>

#include "python/kept_run.h"

namespace sandstroke {

/// The scene with Python functions as laws, for trying out: laws has "relaxation", "displacement" or "force".
/// They are called with the interpreter lock, which a run otherwise releases. Error: input, for another name
/// or a value that is not a function.
SceneHere with_python_laws(SceneHere here, const pybind11::dict& laws);

}  // namespace sandstroke
