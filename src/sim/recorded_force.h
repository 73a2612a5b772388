#pragma once

#include "core/compensated_sum.h"
#include "haptics/stroke.h"
#include "sim/simulation_observer.h"

namespace sandstroke {

/// Holds the forces of a run against those that the hand felt when its stroke was recorded (record --feel),
/// by linear interpolation between samples. Left out are samples whose force the recorder altered
/// (SampleFlag), and where samples are not joined.
class RecordedForce : public SimulationObserver {
 public:
  /// placed: as it is played, with forces.
  explicit RecordedForce(const Stroke& placed) : stroke_(placed) {}
  void on_tick(const TickRecord& tick) override;
  ForceDifference difference() const;

 private:
  bool unaltered(std::size_t sample) const;

  const Stroke& stroke_;
  std::size_t cursor_ = 0;
  CompensatedSum squares_;  // N^2
  double max_ = 0.0;        // N
  std::int64_t ticks_ = 0;
};

}  // namespace sandstroke
