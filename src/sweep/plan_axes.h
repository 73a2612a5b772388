#pragma once

#include <string>

#include "io/toml_reader.h"
#include "sweep/plan_keys.h"
#include "sweep/sweep_plan.h"

namespace sandstroke {

/// The setting that sweep.strokes varies.
inline const std::string stroke_key = "stroke.file";

/// What varies, as a plan says in [axes] and [sweep] (`keys`); axes of a Latin hypercube are sampled. Of
/// `plan` its file and scene must be known. Units are not set. Error: input; io, where a stroke cannot be
/// read.
SweepDesign read_design(const TomlReader& toml, const PlanKeys& keys, const SweepPlan& plan);

}  // namespace sandstroke
