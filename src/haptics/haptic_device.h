#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>

namespace sandstroke {

/// The maximum [N] of a device that takes any force and feels none. It is finite, since files hold no
/// infinity.
inline constexpr double any_force = std::numeric_limits<double>::max();

/// The properties that a device reports.
struct DeviceSpecification {
  std::string model, manufacturer;
  std::string frame = "device";   ///< frame of its positions and forces, as Stroke::frame
  double max_force = 0.0;         ///< N; 0 = it gives none
  double max_stiffness = 0.0;     ///< N/m, of a closed loop; 0 = unknown
  double max_damping = 0.0;       ///< N s/m, of a closed loop; 0 = unknown
  double workspace_radius = 0.0;  ///< m; 0 = unknown
  int switches = 0;               ///< number of switches; 0 = none, or unknown
  bool measures_velocity = false;
  bool measures_orientation = false;
  bool hand_feels = true;  ///< false: a pointer, whose force is only shown
};

/// One reading of a device, as the device gives it: no scaling, no filter.
struct DeviceReading {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();               ///< m, in the device's frame
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();               ///< m/s; 0 if it measures none
  std::uint32_t switches = 0;                                       ///< a bit per switch
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();  ///< of its grip, if it measures that
};

/// A haptic device as the recorder uses it: a real one (chai3d/), or a stand-in. After open(), only one
/// thread calls it; another thread may only call release().
class HapticDevice {
 public:
  virtual ~HapticDevice() = default;

  /// Makes the device ready, without motion or force. Error: io, with what to do.
  virtual void open() = 0;
  /// Calibrates the device. This may move the arm, so it happens on request only. Error: io.
  virtual void calibrate() = 0;
  /// Known before open(), except what only an open device reports. The frame is always known.
  virtual const DeviceSpecification& specification() const = 0;
  /// Whether the positions of an open device are right; none: it does not say.
  virtual std::optional<bool> is_calibrated() const { return true; }
  /// How long there is something to record [s]; none: as long as a hand holds the device.
  virtual std::optional<double> duration() const { return std::nullopt; }
  /// The longest time without readings that is no failure [s]: a recorded stroke that is played has gaps.
  virtual double longest_silence() const { return 0.0; }

  /// Reads the device. Called in the servo loop, so it must not wait, throw or take memory. time [s]: since
  /// the loop began, or its countdown ended; a real device ignores it, a stand-in for a hand moves by it.
  /// False: there is no reading.
  virtual bool read(double time, DeviceReading& reading) noexcept = 0;
  /// Sets the force [N] on the hand, in the device's frame, until the next call. False: the device did not
  /// take it.
  virtual bool command(const Eigen::Vector3d& force) noexcept = 0;
  /// Sets zero force at once. Any thread may call it, even while another call hangs.
  virtual void release() noexcept = 0;
  /// Sets zero force, turns the motors off and closes the device. Does nothing if it is not open.
  virtual void close() noexcept = 0;
};

}  // namespace sandstroke
