#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "haptics/haptic_device.h"

namespace chai3d {
class cGenericHapticDevice;
}

namespace sandstroke {

/// The devices that CHAI3D finds now; none: an empty list. Moves none of them.
std::vector<DeviceSpecification> list_chai3d_devices();

/// The index'th of them, from 0. Error: io (there is none), input (not so many).
std::unique_ptr<HapticDevice> make_chai3d_device(int index);

/// A device of CHAI3D's. Motors stay off until the first force that is not zero.
class Chai3dDevice : public HapticDevice {
 public:
  /// Error: io, where it is no real one.
  /// asks_calibrated: asks the driver about the device that was opened last; empty, or none: it does not say.
  explicit Chai3dDevice(std::shared_ptr<chai3d::cGenericHapticDevice> device,
                        std::function<std::optional<bool>()> asks_calibrated = {});
  ~Chai3dDevice() override { close(); }

  void open() override;
  /// Only where the device says that it needs it. Warns in the log before. Motors are off afterwards: an arm
  /// that nobody holds sinks.
  void calibrate() override;
  const DeviceSpecification& specification() const override { return specification_; }
  std::optional<bool> is_calibrated() const override { return calibrated_; }
  /// A reading is whole or none: false where position, velocity or switches were not to be had.
  bool read(double time, DeviceReading& reading) noexcept override;
  /// The force as it is: CHAI3D cuts none, the recorder's guard has. One that is no number becomes none.
  bool command(const Eigen::Vector3d& force) noexcept override;
  /// From then on forces are refused, until it is opened again.
  void release() noexcept override;
  void close() noexcept override;

 private:
  bool send(const Eigen::Vector3d& force) noexcept;
  void motors_off() noexcept;

  std::shared_ptr<chai3d::cGenericHapticDevice> device_;
  std::function<std::optional<bool>()> asks_calibrated_;
  std::optional<bool> calibrated_;
  DeviceSpecification specification_;
  bool phantom_;
  // Sequentially consistent, for of a release and a command at the same time one must see the other.
  std::atomic<bool> open_{false}, released_{false}, motors_on_{false};
  std::mutex releasing_;  // not in the loop: a device is not closed while it is being released
};

}  // namespace sandstroke
