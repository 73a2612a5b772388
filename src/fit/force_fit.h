#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "fit/confidence.h"

namespace sandstroke {

/// The result of the fit for one constant.
struct FittedConstant {
  ForceConstant constant;
  Eigen::Index index = 0;  ///< of the constant in its law
  double value = 0.0;
  double error = 0.0;  ///< half of the 68 % interval, with the other asked constants free; infinite if kept
  Interval likely;     ///< the 95 % interval, with the other asked constants free
  bool kept = false;   ///< value: the scene's, which the recording does not contradict
  double given_error = 0.0;  ///< as error, with the kept constants at their values; 0: not told
  bool acts = true;          ///< without it the force would change by over a hundredth of what the fit leaves

  /// True if the recording determines it, whatever the other asked constants are. The value is the last
  /// fit's.
  bool determined() const {
    return acts && !kept && value > 0.0 && likely.low >= 0.5 * value && likely.high <= 2.0 * value;
  }
};

/// The force constants that come nearest to a recorded force.
struct ForceFit {
  Eigen::VectorXd values;                 ///< all constants' of the law
  std::vector<FittedConstant> constants;  ///< those that were asked for
  ForceScale of_scale;
  Combination scale;        ///< its best value if all asked constants are free; error: NaN if it is given
  Combination combination;  ///< without powers it is the scale
  double noise_length =
      0.0;  ///< s, how long what is left stays alike (correlation above 1/e); 0: neighbours differ
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
/// Intervals are profiles (Confidence) that cover white noise and noise that lasts. A constant is determined
/// if its 95 % interval, with the others free, is within half and twice its value. One that is not keeps the
/// start's value, unless the recording contradicts that (beyond the 99.9 % interval), and the others are
/// fitted given that value. The first constant never does, because the scale would be lost.
///
/// If interrupted(), the result is not complete.
/// Error: input, if all recorded forces are 0, or fewer than a hundred ticks have a force that the limit does
/// not cut.
/// asked: which of law.constants() to fit.
ForceFit fit_force(const FeltLaw& law, const std::vector<bool>& asked);

}  // namespace sandstroke
