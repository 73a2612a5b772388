#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "haptics/haptic_device.h"

namespace sandstroke {

/// A force, and what was out of the ordinary about it (SampleFlag).
struct FeltForce {
  Eigen::Vector3d force = Eigen::Vector3d::Zero();  ///< N, in the device's frame
  std::uint32_t flags = 0;
  /// N, that sand would give there once the tool moves, where that is more than the force: what the interlock
  /// goes by. A tool that rests deep in the sand may feel nothing.
  double due = 0.0;
  /// false: the tool is where no sand is above which it could be, lower than the highest sand: beside the
  /// bed. What it meets next may be deep in the sand.
  bool is_above_or_in_sand = true;
};

/// What the recorded hand feels. Called in the servo loop: no waiting, throwing, or taking memory.
class FeltWorld {
 public:
  virtual ~FeltWorld() = default;
  /// For a device read at `time` [s] since the recording began; times increase.
  virtual FeltForce feel(double time, const DeviceReading& reading) noexcept = 0;
  /// Before the recording begins: whether the tool would touch anything, or is beside the bed, lower than its
  /// highest sand. Changes nothing that is felt later.
  virtual bool touches(const DeviceReading& reading) noexcept = 0;
};

}  // namespace sandstroke
