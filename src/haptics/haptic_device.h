#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>

namespace sandstroke {

/// N: the maximum of what takes any force and feels none. A number, for infinity is none in files.
inline constexpr double any_force = std::numeric_limits<double>::max();

/// What a device says of itself.
struct DeviceSpecification {
  std::string model, manufacturer;
  std::string frame = "device";   ///< of its positions and forces, as Stroke::frame
  double max_force = 0.0;         ///< N; 0 = it gives none
  double max_stiffness = 0.0;     ///< N/m, of a closed loop; 0 = unknown
  double max_damping = 0.0;       ///< N s/m, of a closed loop; 0 = unknown
  double workspace_radius = 0.0;  ///< m; 0 = unknown
  int switches = 0;               ///< how many it has; 0 = none, or unknown
  bool measures_velocity = false;
  bool measures_orientation = false;
};

/// One look at a device, as it gave it out: no scaling, no filter.
struct DeviceReading {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();               ///< m, in the device's frame
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();               ///< m/s; 0 where it measures none
  std::uint32_t switches = 0;                                       ///< bit by bit
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();  ///< of its grip, where it measures that
};

/// A haptic device as the recorder knows it: a real one (chai3d/), or what stands in for one. After open(),
/// one thread calls it; only release() may come from another.
class HapticDevice {
 public:
  virtual ~HapticDevice() = default;

  /// Makes it ready; it moves nothing and gives no force. Error: io, with what to do.
  virtual void open() = 0;
  /// May move the arm, so nobody calls it unasked. Error: io.
  virtual void calibrate() = 0;
  /// Known before it is opened, but for what only an open device tells of itself (not its frame).
  virtual const DeviceSpecification& specification() const = 0;
  /// Of an open device: whether its positions are right; none: it does not say.
  virtual std::optional<bool> is_calibrated() const { return true; }
  /// For how long there is something to record [s]; none: as long as a hand holds it.
  virtual std::optional<double> duration() const { return std::nullopt; }
  /// For how long it may give nothing and is still there [s]: a recorded stroke that is played has gaps.
  virtual double longest_silence() const { return 0.0; }

  /// In the servo loop, and so without waiting, throwing or taking memory. time [s]: since the loop began, or
  /// its countdown ended; a real device does not need it, what stands in for a hand moves by it. False: it
  /// gave nothing.
  virtual bool read(double time, DeviceReading& reading) noexcept = 0;
  /// force [N] on the hand, in the device's frame, held until the next one. False: it took nothing.
  virtual bool command(const Eigen::Vector3d& force) noexcept = 0;
  /// Zero force, at once, from any thread, even while another call hangs.
  virtual void release() noexcept = 0;
  /// Zero force, motors off, closed; nothing where it is not open.
  virtual void close() noexcept = 0;
};

}  // namespace sandstroke
