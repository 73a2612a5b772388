#pragma once

#include <optional>
#include <span>

#include "fit/felt_stroke.h"
#include "fit/force_fit.h"

namespace sandstroke {

/// A law of force, as a fit knows it.
struct FittedLaw {
  const char* name;  ///< its value of force.law
  std::span<const ForceConstant> constants;
  const char* nature;  ///< its force in words, for a sentence that begins with "it"
  /// Fits the law to a stroke's forces. is_free: which of the constants may change. None if it was
  /// interrupted. Error: as fit_force(), and those of a run.
  std::optional<ForceFit> (*fit)(const FeltStroke& felt, const std::vector<bool>& is_free);
};

/// All laws, in the order of ForceLaw.
std::span<const FittedLaw> fitted_laws();

const FittedLaw& fitted_law(ForceLaw law);

}  // namespace sandstroke
