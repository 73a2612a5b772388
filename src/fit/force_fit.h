#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "fit/felt_law.h"

namespace sandstroke {

/// The result of the fit for one constant.
struct FittedConstant {
  ForceConstant constant;
  double value = 0.0;
  double error = 0.0;  ///< standard error; infinite: the start's value was kept
  bool acts = true;    ///< without it the force would change by over a hundredth of what the fit leaves

  /// True if the recording determines it.
  bool determined() const { return acts && error < value; }
};

/// The force constants that come nearest to a recorded force.
struct ForceFit {
  Eigen::VectorXd values;                 ///< all constants' of the law
  std::vector<FittedConstant> constants;  ///< those that were asked for
  ForceScale of_scale;
  double scale = 0.0, scale_error = 0.0;
  std::int64_t ticks = 0;
  double recorded_rms = 0.0;  ///< N, of the recorded force
  double start_residual = 0.0,
         residual = 0.0;            ///< N rms, what the start's constants and the fitted ones leave
  double explained = 0.0;           ///< fitted fraction of the recorded force's mean square
  double explained_reversed = 0.0;  ///< the same, if the recorded force had the other sign
};

/// Marks the constants with these names; without names, those fitted by default. Error: input, if a name is
/// none of theirs.
std::vector<bool> chosen_constants(std::span<const ForceConstant> constants,
                                   const std::vector<std::string>& names);

/// Fits the force within the device's limit by least squares over all components of all ticks. No constant
/// becomes negative.
///
/// Errors are by the jackknife over ten stretches of time: neighbouring ticks err alike, and a formula for
/// independent ones would promise too much. A constant with rivals or extremes (FeltLaw) keeps the start's
/// value if its error is larger than its value, if a rival changes the force by less than a hundredth of what
/// the fit leaves, or if an extreme does not leave clearly more.
///
/// Error: input, if all recorded forces are 0, or fewer than a hundred ticks have a force that the limit does
/// not cut.
/// asked: which of law.constants() to fit.
ForceFit fit_force(const FeltLaw& law, const std::vector<bool>& asked);

}  // namespace sandstroke
