#include "record/seen_device.h"

#include <gtest/gtest.h>

#include "chai3d/chai3d_device.h"
#include "devices/CGenericHapticDevice.h"

namespace sandstroke {
namespace {

using chai3d::cVector3d;
using Eigen::Vector3d;

cVector3d to_chai3d(const Vector3d& vector) { return {vector.x(), vector.y(), vector.z()}; }

/// A fake device as one of CHAI3D's own kind.
class PlayedDevice : public chai3d::cGenericHapticDevice {
 public:
  double time = 0.0;  ///< s, of the next reading: CHAI3D's devices are not told

  explicit PlayedDevice(FakeDevice& played) : played_(played) {
    const DeviceSpecification& specification = played.specification();
    m_specifications.m_model = chai3d::C_HAPTIC_DEVICE_CUSTOM;
    m_specifications.m_modelName = specification.model;
    m_specifications.m_manufacturerName = specification.manufacturer;
    m_specifications.m_maxLinearForce = specification.max_force;
    m_specifications.m_maxLinearStiffness = specification.max_stiffness;
    m_specifications.m_maxLinearDamping = specification.max_damping;
    m_specifications.m_workspaceRadius = specification.workspace_radius;
    m_specifications.m_sensedPosition = true;
    m_specifications.m_actuatedPosition = specification.max_force > 0.0;
    m_deviceAvailable = true;
  }

  bool open() override {
    played_.open();
    return m_deviceReady = true;
  }
  bool close() override {
    played_.close();
    m_deviceReady = false;
    return true;
  }
  bool calibrate(bool) override {
    played_.calibrate();
    return true;
  }
  bool getPosition(cVector3d& position) override {
    reading_ = {};
    const bool gave = played_.read(time, reading_);
    position = to_chai3d(reading_.position);
    return gave;
  }
  bool getLinearVelocity(cVector3d& velocity) override {
    velocity = to_chai3d(reading_.velocity);
    return true;
  }
  bool getUserSwitches(unsigned& switches) override {
    switches = reading_.switches;
    return true;
  }
  bool setForceAndTorqueAndGripperForce(const cVector3d& force, const cVector3d&, double) override {
    const bool taken = played_.command({force.x(), force.y(), force.z()});
    --played_.commands;  // counts what the recorder commands: below
    return taken;
  }
  bool enableForces(bool enabled) override {
    if (!enabled) played_.held.setZero();
    return true;
  }

 private:
  FakeDevice& played_;
  DeviceReading reading_;
};

/// The device as the recorder gets to see it.
class SeenDevice : public HapticDevice {
 public:
  explicit SeenDevice(FakeDevice& played)
      : played_(played), device_(std::make_shared<PlayedDevice>(played)), seen_(device_) {}

  void open() override {
    seen_.open();
    specification_ = seen_.specification();
    specification_.switches = played_.specification().switches;  // CHAI3D does not say
  }
  void calibrate() override { seen_.calibrate(); }
  const DeviceSpecification& specification() const override { return specification_; }
  std::optional<bool> is_calibrated() const override { return played_.is_calibrated(); }
  std::optional<double> duration() const override { return played_.duration(); }
  bool read(double time, DeviceReading& reading) noexcept override {
    device_->time = time;
    return seen_.read(time, reading);
  }
  bool command(const Vector3d& force) noexcept override {
    ++played_.commands;
    return seen_.command(force);
  }
  void release() noexcept override {
    seen_.release();
    EXPECT_EQ(played_.held, Vector3d::Zero());
    played_.release();
  }
  void close() noexcept override { seen_.close(); }

 private:
  FakeDevice& played_;
  std::shared_ptr<PlayedDevice> device_;
  Chai3dDevice seen_;
  DeviceSpecification specification_;
};

}  // namespace

std::shared_ptr<HapticDevice> seen(FakeDevice& device) { return std::make_shared<SeenDevice>(device); }

const bool zero_is_sent_twice = false;

}  // namespace sandstroke
