#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "haptics/haptic_device.h"

namespace sandstroke {

/// A force, and what was unusual about it (SampleFlag).
struct FeltForce {
  Eigen::Vector3d force = Eigen::Vector3d::Zero();  ///< N, in the device's frame
  std::uint32_t flags = 0;
  /// N, the force that sand would give there once the tool moves, where that is more than `force`. The
  /// interlock uses it: a tool that rests deep in the sand may feel nothing.
  double due = 0.0;
  /// false: the tool is beside the bed, lower than its highest sand. There is no sand that it could be above,
  /// and the sand it meets next may be deep.
  bool is_above_or_in_sand = true;
};

/// The world that the recorded hand feels. Called in the servo loop: it must not wait, throw, or take memory.
class FeltWorld {
 public:
  virtual ~FeltWorld() = default;
  /// The force for a device that was read at `time` [s] since the recording began. Times increase.
  virtual FeltForce feel(double time, const DeviceReading& reading) noexcept = 0;
  /// Before the recording begins: true where the tool would touch anything, or is beside the bed, lower than
  /// its highest sand. Changes nothing that is felt later.
  virtual bool touches(const DeviceReading& reading) noexcept = 0;
};

}  // namespace sandstroke
