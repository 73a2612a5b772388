#pragma once

#include "fit/felt_law.h"

namespace sandstroke {

/// A least-squares problem: which values may change, and what the force should be [N, a column for each
/// tick].
struct LeastSquares {
  const FeltLaw& law;
  Eigen::Matrix3Xd recorded;
  std::vector<bool> is_free;

  /// The force that these values leave, N rms over the ticks.
  double residual(const Eigen::VectorXd& values) const;
  /// The values that leave least, over all components of all ticks (Levenberg and Marquardt). The search
  /// begins at `from`; values that are not free stay as they are there.
  Eigen::VectorXd solved(const Eigen::VectorXd& from) const;
  /// The better of two fits, from the law's start and from weak sand. Where the device's limit cuts every
  /// force, no constant changes the force, and a fit would stay where it began.
  Eigen::VectorXd best() const;
};

/// The root mean square of the columns [N].
double rms(const Eigen::Matrix3Xd& forces);

}  // namespace sandstroke
