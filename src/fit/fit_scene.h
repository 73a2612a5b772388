#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "fit/felt_ticks.h"
#include "fit/force_fit.h"

namespace sandstroke {

/// The constants of a scene's law of force.
std::span<const ForceConstant> constants_of(ForceLaw law);

/// What the scene's fit is given, from its files. Error: input, where the scene has no stroke or the stroke
/// no forces; io.
FeltStroke felt_stroke(const Scene& scene, const std::filesystem::path& scene_folder);

/// The fit of the scene's law to the stroke's forces; is_free: of constants_of(). Where the force of a
/// contact is not linear in what is free, the run is played again with sands ever closer about the best, to 2
/// % of it. None where it was interrupted. Error: as fit_force(), and those of a run.
std::optional<ForceFit> fit_stroke(const FeltStroke& felt, const std::vector<bool>& is_free);

}  // namespace sandstroke
