#pragma once

#include "fit/felt_law.h"

namespace sandstroke {

/// Ticks begin to end - 1 of a law's.
struct Stretch {
  Eigen::Index begin = 0, end = 0;
};

/// Which values may change and what the force should be [N, a column for each tick].
struct LeastSquares {
  const FeltLaw& law;
  Eigen::Matrix3Xd recorded;
  std::vector<bool> is_free;

  /// N rms over the ticks.
  double residual(const Eigen::VectorXd& values) const;
  /// The values that leave least, over all components of all ticks but those of a stretch (Levenberg and
  /// Marquardt), from some on; values that are not free stay as they are there.
  Eigen::VectorXd solved(const Eigen::VectorXd& from, Stretch left_out = {}) const;
  /// The better of those from the law's start and from weak sand: where the device's limit cuts every force,
  /// no constant changes any, and a fit would stay where it began.
  Eigen::VectorXd best() const;
};

/// N, of columns.
double rms(const Eigen::Matrix3Xd& forces);

}  // namespace sandstroke
