#pragma once

#include <string>
#include <vector>

#include "haptics/repeated_samples.h"
#include "haptics/stroke.h"
#include "haptics/stroke_plane.h"

namespace sandstroke {

/// How well the samples of a stroke describe the motion of a hand.
struct StrokeQuality {
  double jitter = 0.0;  ///< s, rms of the spacings about their median, over joined samples
  Repeats repeats;
  /// m rms, the part that no parabola through neighbours explains: from robust third differences of the
  /// samples that repeat nothing.
  double noise = 0.0;
  double usual_speed = 0.0;                          ///< m/s, median over the steps that move
  double top_speed = 0.0;                            ///< m/s, of the fastest step,
  double top_time = 0.0;                             ///< s, the start of that step
  LeastSquaresPlane plane;                           ///< through the samples with the pen down
  Eigen::Vector3d extent = Eigen::Vector3d::Zero();  ///< m, of the same samples
};
StrokeQuality quality_of(const Stroke& stroke);

/// Returns a sentence for each thing that will matter in a run: metres that may be millimetres, repeated
/// samples, speeds that no hand has, and jumps.
std::vector<std::string> quality_warnings(const StrokeQuality& quality);

}  // namespace sandstroke
