#pragma once

#include <optional>
#include <string>
#include <vector>

#include "haptics/stroke.h"
#include "sim/run_result.h"

namespace sandstroke {

/// The force that the hand felt when its stroke was recorded, at any time: linear between samples.
class RecordedForce {
 public:
  /// placed: the stroke as it is played.
  explicit RecordedForce(const Stroke& placed)
      : stroke_(placed), sign_(placed.force_sign == ForceSign::by_hand ? -1.0 : 1.0) {}
  /// [N] on the device, in the stroke's frame, `time` [s] after its first sample; not called with earlier
  /// times later. Not-a-number where none was recorded, where the recorder altered it (SampleFlag), and
  /// between samples that are not joined.
  Eigen::Vector3d at(double time);

 private:
  bool unaltered(std::size_t sample) const;

  const Stroke& stroke_;
  double sign_;
  std::size_t cursor_ = 0;
};

/// The forces of one tick.
struct ForcePair {
  double time;                    ///< s
  Eigen::Vector3d run, recorded;  ///< N; recorded: not-a-number where it is not known
};
inline ForcePair forces_of(const TickRecord& tick) {
  return {tick.time, tick.device_force, tick.recorded_force};
}

/// How well the forces of a run and those that were recorded agree, over the ticks that have both. None: no
/// tick has.
///
/// The correlation is that of the vectors, each less its mean: sum(a.b) / sqrt(sum(a.a) sum(b.b)). The lag is
/// that at which the correlation is largest, of whole ticks up to half a second either way and with at least
/// half of the ticks in both; long traces are searched through evenly chosen ticks. Where
/// it still grows at half a second, there is no lag: 0. A force that never changes correlates with nothing:
/// not-a-number.
std::optional<ForceAgreement> force_agreement(const std::vector<ForcePair>& ticks);

/// "differs from the run's by 0.3 N rms ...": in a sentence that begins with the recorded force.
std::string text_of(const ForceAgreement& agreement);

}  // namespace sandstroke
