#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <vector>

#include "haptics/stroke.h"

namespace sandstroke {

/// The hand at one instant.
struct Hand {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();               ///< m
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();               ///< m/s, the derivative of position
  bool down = false;                                                ///< false: lifted, nothing is touched
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();  ///< of the tool

  template <class State>
  void visit_state(State& state) {
    state.value("position", position);
    state.value("velocity", velocity);
    state.value("down", down);
    state.value("orientation", orientation.coeffs());
  }
};

/// A stretch of time in which the tool is lifted.
struct StrokeGap {
  double begin = 0.0, end = 0.0;  ///< s
};

/// A stroke at any time, between its irregular samples.
///
/// Each joined piece (Stroke::joined) is a piecewise cubic through the samples. Its height is monotone from
/// sample to sample (Fritsch & Carlson, SIAM J. Numer. Anal. 17, 1980; slopes by the weighted harmonic mean,
/// one-sided at the ends, as pchip does): it is never deeper than the deeper of the two samples around it.
/// Its horizontal velocity at a sample is that of the parabola through three samples, but no more than
/// (1 + cos a) times the slower of the two mean velocities around it, a being the angle between them. So the
/// curve turns with the coordinates about z, is of third order on smooth ways, rests where two samples are
/// equal, goes neither back nor too far on a straight line, and stays within a third of its chord's length of
/// the chord (beside an end of a piece, two thirds). Across a gap the hand moves straight and lifted. A piece
/// of one sample is a point, down at exactly its time.
///
/// The tool turns from sample to sample by the shortest way, also in gaps: the normalised straight line
/// between two quaternions, whose angle is of second order in the samples' spacing, as if it turned
/// uniformly.
class StrokeSampler {
 public:
  /// The stroke must have passed check_stroke.
  explicit StrokeSampler(Stroke stroke);

  /// The hand at time t. Cheap (amortised O(1)) if t does not decrease from call to call; right in any order.
  /// Before the start and after the end the hand rests, lifted.
  Hand at(double t);

  const Stroke& stroke() const { return stroke_; }
  double start_time() const { return stroke_.time.front(); }
  double end_time() const { return stroke_.time.back(); }
  const std::vector<StrokeGap>& gaps() const { return gaps_; }
  /// Whether the tool is lifted at any time after begin and before end [s]; begin < end.
  bool lifts_between(double begin, double end) const;

 private:
  void seek(double t);
  void find_slopes();
  Hand joined_or_lifted(double t) const;
  Hand on_curve(double t) const;
  Hand lifted(double t) const;
  Eigen::Vector3d slope(std::size_t sample) const;
  Eigen::Quaterniond orientation_at(double t) const;

  Stroke stroke_;
  std::vector<StrokeGap> gaps_;
  std::size_t cursor_ = 0;                   // time[cursor_] <= t < time[cursor_ + 1]
  Eigen::Vector3d begin_slope_, end_slope_;  // of the curve at samples cursor_ and cursor_ + 1
};

}  // namespace sandstroke
