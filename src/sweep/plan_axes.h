#pragma once

#include <string>

#include "io/toml_reader.h"
#include "sweep/plan_keys.h"
#include "sweep/sweep_plan.h"

namespace sandstroke {

/// The setting that sweep.strokes varies.
inline const std::string stroke_key = "stroke.file";

/// Reads the axes from a plan's [axes] and [sweep] (`keys`), and samples those of a Latin hypercube. Needs
/// the file and the scene of `plan`. Does not set units. Error: input; io, if a stroke cannot be read.
SweepDesign read_design(const TomlReader& toml, const PlanKeys& keys, const SweepPlan& plan);

}  // namespace sandstroke
