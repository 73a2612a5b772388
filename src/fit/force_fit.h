#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "haptics/force_model.h"

namespace sandstroke {

/// A tick in which the tool touched sand and a force was recorded.
struct FeltTick {
  double depth = 0.0;        ///< m, of the tip below the sand's level, > 0
  Eigen::Vector3d velocity;  ///< m/s, of the tool in the bed
  Eigen::Vector3d recorded;  ///< N, on the hand
};

/// The constants of the force that can be fitted: members of ForceSettings.
struct ForceConstant {
  const char *name, *unit, *key;  ///< key: in a scene
  double ForceSettings::*value;
};
inline constexpr ForceConstant force_constants[] = {{"k_s", "N", "force.k_s", &ForceSettings::k_s},
                                                    {"k_c", "1/m", "force.k_c", &ForceSettings::k_c},
                                                    {"k_f", "s/m", "force.k_f", &ForceSettings::k_f}};

/// What the fit says of one constant.
struct FittedConstant {
  ForceConstant constant;
  double value = 0.0;
  double error = 0.0;  ///< standard error; infinite: the start's value was kept
  bool acts = true;    ///< without it the force would change by over a hundredth of what the fit leaves

  /// The recording determines it.
  bool determined() const { return acts && error < value; }
};

/// The force constants that come nearest to a recorded force.
struct ForceFit {
  ForceSettings force;                            ///< with the fitted constants
  std::vector<FittedConstant> constants;          ///< those that were asked for
  double stiffness = 0.0, stiffness_error = 0.0;  ///< N/m, k_s k_c: how the force begins to grow with depth
  std::int64_t ticks = 0;
  double recorded_rms = 0.0;  ///< N, of the recorded force
  double start_residual = 0.0,
         residual = 0.0;            ///< N rms, left with the start's constants and the fitted ones
  double explained = 0.0;           ///< share of the recorded force's mean square
  double explained_reversed = 0.0;  ///< the same, had the recorded force the other sign
};

/// Least squares over all components of all ticks (Levenberg and Marquardt), from `start` on, of the force
/// that sand_force() gives with that limit [N, 0: none]. The constants are not negative.
///
/// Errors are by the jackknife over ten stretches of time: neighbouring ticks err alike, and a formula for
/// independent ones would promise too much. Where the error of k_c is larger than its value, or k_c
/// bends the force by less than a hundredth of what the fit leaves, only k_s k_c is known: the start's k_c is
/// kept.
///
/// names: of force_constants. Error: input, where a name is none of these, all recorded forces are
/// 0, or fewer than a hundred ticks have a force that the limit does not cut.
ForceFit fit_force(const std::vector<FeltTick>& ticks, const ForceSettings& start, double max_force,
                   const std::vector<std::string>& names);

}  // namespace sandstroke
