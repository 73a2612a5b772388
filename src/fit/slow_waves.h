#pragma once

#include <Eigen/Core>

namespace sandstroke {

/// How far noise in a force moves the sum of its products with a direction: as far as it moves the sums with
/// the direction times slow cosines, which see the same lasting noise. Neighbours may err alike, over much
/// less than the recording (the equal-weighted cosine estimator; Lazarus, Lewis, Stock and Watson, Journal of
/// Business & Economic Statistics 36, 2018). The noise is what a fit has left. That the fit took some of it
/// away is made good, exactly for white noise.
class SlowWaves {
 public:
  static constexpr Eigen::Index count = 8;
  /// Student's t with so many degrees of freedom lies within these in 68, 95 and 99.9 % of cases.
  static constexpr double within_68 = 1.0602, within_95 = 2.3060, within_999 = 5.0413;

  /// fitted: how the force grows with each number that was fitted, a column for each; rows: all components of
  /// all ticks.
  explicit SlowWaves(const Eigen::MatrixXd& fitted);

  /// The standard error of the sum of direction x noise. Over it, the sum is distributed as Student's t with
  /// `count` degrees of freedom.
  double error_of_sum(const Eigen::Matrix3Xd& direction, const Eigen::Matrix3Xd& noise) const;

 private:
  Eigen::MatrixXd fitted_;  // orthonormal columns
  Eigen::MatrixXd waves_;   // a column for each
};

/// How many columns apart the columns of `noise` are still alike: their correlation is above 1/e. 0: not even
/// neighbours are.
Eigen::Index correlation_length(const Eigen::Matrix3Xd& noise);

}  // namespace sandstroke
