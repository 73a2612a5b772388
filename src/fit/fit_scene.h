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

/// Loads the input of a fit from the scene's files. Error: input, if the scene has no stroke or the stroke no
/// forces; io.
FeltStroke felt_stroke(const Scene& scene, const std::filesystem::path& scene_folder);

/// Fits the scene's law to the stroke's forces. is_free: which of constants_of() may change. If the force of
/// a contact is not linear in these, the run is played again, with sands around the best values so far, until
/// these change by at most 1 %, but no more than five times in all. None if it was interrupted. Error: as
/// fit_force(), and those of a run.
std::optional<ForceFit> fit_stroke(const FeltStroke& felt, const std::vector<bool>& is_free);

}  // namespace sandstroke
