#pragma once

#include "fit/least_squares.h"
#include "fit/slow_waves.h"

namespace sandstroke {

/// From low to high. 0 and infinity: the recording sets no limit on that side.
struct Interval {
  double low = 0.0, high = 0.0;

  bool contains(double value) const { return low <= value && value <= high; }
};

/// What a recording says of each constant of a fit while the other free ones follow (the profile). It holds
/// for white noise and for noise that is correlated over much less than the recording, and where the force
/// bends or stops growing with the constant.
class Confidence {
 public:
  /// best: the values that leave least.
  Confidence(const LeastSquares& problem, Eigen::VectorXd best);

  /// How many standard errors this value of a free constant, with the other free ones fitted anew, is from
  /// the best: D (D + r) / error of D r, where r is what the best force leaves and D the change of the force,
  /// summed over ticks. Of the true value it is distributed as the size of Student's t (SlowWaves).
  double distance(std::size_t constant, double value) const;

  /// The values of a free constant up to that distance, to 2 % of it or 1e-6 of the value.
  Interval interval(std::size_t constant, double distance) const;

 private:
  double end(std::size_t constant, double outermost, double open, double distance) const;

  LeastSquares problem_;
  Eigen::VectorXd best_;
  Eigen::Matrix3Xd force_, left_;
  SlowWaves waves_;
};

/// The scale of a law times powers of those constants that a fit keeps: scale x product of
/// (constant / kept value)^power. It stays the same if these change and the others are fitted anew (the
/// direction of the covariance in which the recording says most).
struct Combination {
  Eigen::VectorXd powers;           ///< of all constants; in hundredths; 0 of those that are free
  double value = 0.0, error = 0.0;  ///< error: half of the 68 % interval, with all of `asked` free
};

/// The combination about a fit's values. problem: with what is free in the fit. asked: also what is kept.
Combination combination_about(const LeastSquares& problem, const std::vector<bool>& asked,
                              const Eigen::VectorXd& values);

/// The scale alone, with all of `asked` free.
Combination scale_about(const LeastSquares& problem, const std::vector<bool>& asked,
                        const Eigen::VectorXd& values);

}  // namespace sandstroke
