#include "chai3d/chai3d_device.h"

#include <spdlog/spdlog.h>

#include <chrono>
#include <thread>

#include "core/error.h"
// Only this file includes CHAI3D's headers.
#ifndef LINUX
#error "CHAI3D was compiled with LINUX; define it here, too, or classes get other sizes than in its library"
#endif
#include "devices/CGenericHapticDevice.h"
#include "devices/CHapticDeviceHandler.h"
#include "drdc.h"

namespace sandstroke {
namespace {

using chai3d::cHapticDeviceInfo;
using chai3d::cVector3d;

DeviceSpecification specification_of(const cHapticDeviceInfo& info) {
  DeviceSpecification specification;
  specification.model = info.m_modelName;
  specification.manufacturer = info.m_manufacturerName;
  // CHAI3D's frame (+x towards the operator, +y to the operator's right, +z up) has the name "device".
  if (info.m_actuatedPosition) specification.max_force = info.m_maxLinearForce;  // trackers have no motors
  specification.max_stiffness = info.m_maxLinearStiffness;
  specification.max_damping = info.m_maxLinearDamping;
  specification.workspace_radius = info.m_workspaceRadius;
  specification.switches = 0;  // CHAI3D does not say
  specification.measures_velocity = true;
  specification.measures_orientation = info.m_sensedRotation;
  return specification;
}

bool is_phantom(chai3d::cHapticDeviceModel model) {
  return model >= chai3d::C_HAPTIC_DEVICE_PHANTOM_TOUCH && model <= chai3d::C_HAPTIC_DEVICE_PHANTOM_OTHER;
}

/// Asks Force Dimension's driver about the device that was opened last in this thread. CHAI3D does not say
/// whether a device is calibrated, nor which number the driver gives it.
std::optional<bool> drd_is_calibrated() {
  if (!drdIsSupported()) return std::nullopt;
  return drdIsInitialized();
}

Eigen::Vector3d from_chai3d(const cVector3d& vector) { return {vector.x(), vector.y(), vector.z()}; }

/// A measured matrix is only nearly a rotation, so the result is normalised.
Eigen::Quaterniond from_chai3d(const chai3d::cMatrix3d& rotation) {
  Eigen::Matrix3d matrix;
  for (int row = 0; row < 3; ++row)
    for (int col = 0; col < 3; ++col) matrix(row, col) = rotation(row, col);
  return Eigen::Quaterniond(matrix).normalized();
}

}  // namespace

std::vector<DeviceSpecification> list_chai3d_devices() {
  chai3d::cHapticDeviceHandler handler;
  std::vector<DeviceSpecification> devices;
  for (unsigned index = 0; index < handler.getNumDevices(); ++index) {
    cHapticDeviceInfo info;
    if (handler.getDeviceSpecifications(info, index)) devices.push_back(specification_of(info));
  }
  return devices;
}

std::unique_ptr<HapticDevice> make_chai3d_device(int index) {
  chai3d::cHapticDeviceHandler handler;
  // Asks for the number first: where there is no device, getDevice gives out a dummy.
  const int count = static_cast<int>(handler.getNumDevices());
  if (count == 0)
    throw_io_error(
        "CHAI3D finds no haptic device: connect it, switch it on and give this user access to it (Force "
        "Dimension: install the udev rule in CHAI3D's externals/DHD/doc/linux; 3D Systems: put libHD.so and "
        "CHAI3D's libhdPhantom.so where the loader finds them)");
  if (index < 0 || index >= count)
    throw_input_error("there is no haptic device {}: CHAI3D finds {} in all and counts them from 0", index,
                      count);
  chai3d::cGenericHapticDevicePtr device;
  if (!handler.getDevice(device, static_cast<unsigned>(index)))
    throw_io_error("CHAI3D gives no access to haptic device {}: unplug it, plug it in again, and try again",
                   index);
  return device->m_specifications.m_manufacturerName == "Force Dimension"
             ? std::make_unique<Chai3dDevice>(device, drd_is_calibrated)
             : std::make_unique<Chai3dDevice>(device);
}

Chai3dDevice::Chai3dDevice(std::shared_ptr<chai3d::cGenericHapticDevice> device,
                           std::function<std::optional<bool>()> asks_calibrated)
    : device_(std::move(device)), asks_calibrated_(std::move(asks_calibrated)) {
  // getDevice gives out a dummy where there is no device. The dummy is not available, and its model is never
  // set, so the model must not be read or copied.
  const cHapticDeviceInfo& info = device_->m_specifications;
  if (!device_->isDeviceAvailable() || !info.m_sensedPosition ||
      info.m_model == chai3d::C_HAPTIC_DEVICE_VIRTUAL)
    throw_io_error("\"{}\" is not a real haptic device: connect one, and switch it on", info.m_modelName);
  specification_ = specification_of(info);
  phantom_ = is_phantom(info.m_model);
}

void Chai3dDevice::open() {
  if (open_) return;
  if (!device_->open() || !device_->isDeviceReady())
    throw_io_error(
        "the haptic device {} cannot be opened: end other programs that use it, unplug it, plug it in again, "
        "and try again",
        specification_.model);
  specification_ = specification_of(device_->m_specifications);  // now the device itself was asked
  if (asks_calibrated_) calibrated_ = asks_calibrated_();
  released_ = false;
  motors_on_ = false;
  open_ = true;
}

void Chai3dDevice::calibrate() {
  spdlog::warn("the haptic device {} may now move by itself to calibrate: keep hands and things off it",
               specification_.model);
  constexpr bool even_if_calibrated = false;
  const bool calibrated = device_->calibrate(even_if_calibrated);
  device_->enableForces(false);  // Force Dimension's driver leaves the motors on
  if (!calibrated)
    throw_io_error(
        "the haptic device {} could not calibrate itself: remove what blocks its arm, or calibrate it by "
        "hand as its manual describes, and try again",
        specification_.model);
  if (asks_calibrated_) calibrated_ = asks_calibrated_();
}

bool Chai3dDevice::read(double, DeviceReading& reading) noexcept {
  if (!open_ || !device_->isDeviceReady()) return false;
  cVector3d position(0, 0, 0), velocity(0, 0, 0);
  unsigned switches = 0;
  // cPhantomDevice::getPosition (3.3.0) returns `error != 0`, so false on success, of a call that fails only
  // while the device is not open. So its result is ignored for a Phantom, whichever way round it is.
  const bool positioned = device_->getPosition(position) || phantom_;
  // CHAI3D makes the velocity from its readings within 15 ms of wall time (Force Dimension: by another
  // reading, which takes time). The position is as measured.
  if (!positioned || !device_->getLinearVelocity(velocity) || !device_->getUserSwitches(switches))
    return false;
  if (specification_.measures_orientation) {
    chai3d::cMatrix3d rotation;
    rotation.identity();
    if (!device_->getRotation(rotation)) return false;
    reading.orientation = from_chai3d(rotation);
  }
  reading.position = from_chai3d(position);
  reading.velocity = from_chai3d(velocity);
  reading.switches = switches;
  return true;
}

bool Chai3dDevice::command(const Eigen::Vector3d& force) noexcept {
  if (!open_) return false;
  // Nothing is sent before the first force that is not zero. The first force sent, even zero, switches on the
  // motors of Force Dimension's devices, although their button has switched them off.
  if (!motors_on_ && force.isZero(0.0)) return true;
  if (released_) return false;
  if (!force.allFinite()) {
    if (motors_on_) send(Eigen::Vector3d::Zero());
    return false;
  }
  const bool motors = motors_on_.exchange(true) || device_->enableForces(true);
  if (!motors) motors_on_ = false;  // tries again next time: no force is given while they are off
  const bool taken = motors && send(force);
  if (released_) motors_off();  // released while this force was on its way: release() has the last word
  return taken;
}

void Chai3dDevice::release() noexcept {
  const std::scoped_lock lock(releasing_);
  released_ = true;
  // This does not wait for the loop, because the loop may hang in the driver. CHAI3D's classes lock nothing:
  // a second call changes only their copies of the last force, which nobody reads. Below them, a Phantom's
  // force is a number that the driver's own thread sends. It goes on sending while the loop hangs, so
  // release() is needed. Force Dimension's driver locks each transfer, so this waits only for a transfer that
  // hangs.
  if (open_ && motors_on_) motors_off();
}

void Chai3dDevice::close() noexcept {
  release();
  const std::scoped_lock lock(releasing_);
  if (!open_.exchange(false)) return;
  device_->enableForces(false);
  // Closing ends the driver's thread, which sends a Phantom its force 1000 times a second. Let it send the
  // zero first.
  if (phantom_) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  device_->close();
}

bool Chai3dDevice::send(const Eigen::Vector3d& force) noexcept {
  return device_->setForce(cVector3d(force.x(), force.y(), force.z()));
}

void Chai3dDevice::motors_off() noexcept {
  motors_on_ = false;
  send(Eigen::Vector3d::Zero());
  device_->enableForces(false);
}

}  // namespace sandstroke
