#pragma once

#include <array>
#include <atomic>
#include <string>

#include "haptics/haptic_device.h"
#include "haptics/stroke_sampler.h"

namespace sandstroke {

/// A stand-in for people without a device. Its hand moves along a stroke, scripted or recorded, in real time,
/// and rests at its end. It takes any force and feels nothing.
///
/// Where the stroke has no samples (they are further apart than its gap_threshold, or the pen lifts), nothing
/// is read, because nobody knows where the hand was. The recording then has the same gap, not a line across
/// it. A device knows no pen: samples with the pen up are played as positions like all others. A pen that was
/// lifted on a tablet must also be lifted in space (as scripts do, by their clearance) not to draw.
class StrokeDevice : public HapticDevice {
 public:
  /// The stroke must have passed check_stroke. name: the model in its specification.
  StrokeDevice(Stroke stroke, std::string name);

  void open() override {}
  void calibrate() override {}
  const DeviceSpecification& specification() const override { return specification_; }
  /// The stroke's.
  std::optional<double> duration() const override { return sampler_.stroke().duration(); }
  /// Its longest gap.
  double longest_silence() const override { return longest_silence_; }
  /// time [s]: since the stroke's first sample. The switches are those of the last sample up to `time`.
  bool read(double time, DeviceReading& reading) noexcept override;
  bool command(const Eigen::Vector3d& force) noexcept override;
  void release() noexcept override { command(Eigen::Vector3d::Zero()); }
  void close() noexcept override { release(); }

  /// The last force commanded [N]; from any thread.
  Eigen::Vector3d force() const;

 private:
  StrokeSampler sampler_;
  DeviceSpecification specification_;
  double longest_silence_ = 0.0;                // s
  std::array<std::atomic<double>, 3> force_{};  // N
};

}  // namespace sandstroke
