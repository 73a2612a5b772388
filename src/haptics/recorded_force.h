#pragma once

#include "haptics/stroke.h"

namespace sandstroke {

/// The force that was recorded with a stroke, at any time: linear between samples.
class RecordedForce {
 public:
  /// placed: the stroke as it is played.
  explicit RecordedForce(const Stroke& placed)
      : stroke_(placed), sign_(placed.force_sign == ForceSign::by_hand ? -1.0 : 1.0) {}
  /// The force [N] on the device, in the stroke's frame, `time` [s] after its first sample. Later calls must
  /// not have earlier times. NaN if none was recorded, if the recorder altered it or no hand felt it
  /// (SampleFlag), and between samples that are not joined.
  Eigen::Vector3d at(double time);

 private:
  bool unaltered(std::size_t sample) const;

  const Stroke& stroke_;
  double sign_;
  std::size_t cursor_ = 0;
};

}  // namespace sandstroke
