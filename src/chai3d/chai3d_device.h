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

/// The devices that CHAI3D finds now; an empty list where there are none. Moves none of them.
std::vector<DeviceSpecification> list_chai3d_devices();

/// The device of this index, from 0. Error: io (there is no device), input (there are fewer).
std::unique_ptr<HapticDevice> make_chai3d_device(int index);

/// A device that CHAI3D drives. Its motors stay off until the first force that is not zero.
class Chai3dDevice : public HapticDevice {
 public:
  /// Error: io, where it is no real device.
  /// asks_calibrated: asks the driver about the device that was opened last; empty, or none: unknown.
  explicit Chai3dDevice(std::shared_ptr<chai3d::cGenericHapticDevice> device,
                        std::function<std::optional<bool>()> asks_calibrated = {});
  ~Chai3dDevice() override { close(); }

  void open() override;
  /// Calibrates only a device that says it needs it. Warns in the log before. Motors are off afterwards: an
  /// arm that nobody holds sinks.
  void calibrate() override;
  const DeviceSpecification& specification() const override { return specification_; }
  std::optional<bool> is_calibrated() const override { return calibrated_; }
  /// False where position, velocity or switches could not be read: a reading is whole or none.
  bool read(double time, DeviceReading& reading) noexcept override;
  /// Sends the force as it is: the recorder's guard has cut it. A force that is no number becomes none.
  bool command(const Eigen::Vector3d& force) noexcept override;
  /// Refuses forces from now on, until the device is opened again.
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
  // Sequentially consistent: if release() and command() run at the same time, one must see the other.
  std::atomic<bool> open_{false}, released_{false}, motors_on_{false};
  std::mutex releasing_;  // not in the loop: a device must not be closed while it is being released
};

}  // namespace sandstroke
