#pragma once

#include <Eigen/Core>
#include <functional>
#include <mutex>
#include <string>
#include <vector>

#include "devices/CGenericHapticDevice.h"

namespace sandstroke {

/// A device of CHAI3D's own kind that does as a test says, and remembers what was done to it.
class FakeChai3d : public chai3d::cGenericHapticDevice {
 public:
  // Readings that it gives:
  bool opens = true, calibrates = true;
  bool gives_position = true, gives_velocity = true, gives_switches = true, takes_force = true;
  bool switches_on = true;
  chai3d::cVector3d position{0, 0, 0}, velocity{0, 0, 0};
  unsigned switches = 0;
  chai3d::cMatrix3d rotation{1, 0, 0, 0, 1, 0, 0, 0, 1};
  std::function<void(const Eigen::Vector3d&)> on_force;  ///< called while a force is on its way

  explicit FakeChai3d(chai3d::cHapticDeviceModel model = chai3d::C_HAPTIC_DEVICE_OMEGA_3) {
    m_specifications.m_model = model;
    m_specifications.m_modelName = "fake";
    m_specifications.m_manufacturerName = "nobody";
    m_specifications.m_maxLinearForce = 12.0;
    m_specifications.m_maxLinearStiffness = 5000.0;
    m_specifications.m_maxLinearDamping = 30.0;
    m_specifications.m_workspaceRadius = 0.075;
    m_specifications.m_sensedRotation = true;
    m_specifications.m_sensedPosition = m_specifications.m_actuatedPosition = true;
    m_deviceAvailable = true;
  }

  /// Fails as when its cable is pulled out.
  void unplug() { m_deviceAvailable = m_deviceReady = false; }

  // Calls that were made to it:
  std::vector<std::string> calls() const {
    const std::scoped_lock lock(mutex_);
    return calls_;
  }
  Eigen::Vector3d held() const {
    const std::scoped_lock lock(mutex_);
    return held_;
  }
  bool motors() const {
    const std::scoped_lock lock(mutex_);
    return motors_;
  }

  bool open() override {
    note("open");
    return m_deviceReady = m_deviceAvailable && opens;
  }
  bool close() override {
    note("close");
    const bool was_open = m_deviceReady;
    m_deviceReady = false;
    return was_open;
  }
  bool calibrate(bool even_if_calibrated) override {
    note(even_if_calibrated ? "calibrate again" : "calibrate");
    set_motors(true);  // as cDeltaDevice leaves them
    return calibrates;
  }
  bool getPosition(chai3d::cVector3d& value) override { return give(gives_position, position, value); }
  bool getLinearVelocity(chai3d::cVector3d& value) override { return give(gives_velocity, velocity, value); }
  bool getRotation(chai3d::cMatrix3d& value) override { return give(true, rotation, value); }
  bool getUserSwitches(unsigned& value) override { return give(gives_switches, switches, value); }
  bool enableForces(bool enabled) override {
    note(enabled ? "motors on" : "motors off");
    if (enabled && !switches_on) return false;
    set_motors(enabled);
    return true;
  }
  bool setForceAndTorqueAndGripperForce(const chai3d::cVector3d& force, const chai3d::cVector3d&,
                                        double) override {
    const Eigen::Vector3d value(force.x(), force.y(), force.z());
    if (on_force) on_force(value);
    if (!takes_force) return false;
    note("force");
    const std::scoped_lock lock(mutex_);
    held_ = value;
    return true;
  }

 private:
  void note(const std::string& call) {
    const std::scoped_lock lock(mutex_);
    calls_.push_back(call);
  }
  void set_motors(bool on) {
    const std::scoped_lock lock(mutex_);
    motors_ = on;
  }
  template <class Value>
  bool give(bool gives, const Value& given, Value& value) const {
    if (!m_deviceReady || !gives) return false;
    value = given;
    return true;
  }

  mutable std::mutex mutex_;
  std::vector<std::string> calls_;
  Eigen::Vector3d held_ = Eigen::Vector3d::Zero();  // N
  bool motors_ = false;
};

/// A device like cPhantomDevice of 3.3.0, which says false where it read, and true where not.
class FakePhantom : public FakeChai3d {
 public:
  using FakeChai3d::FakeChai3d;
  bool getPosition(chai3d::cVector3d& value) override { return !FakeChai3d::getPosition(value); }
};

}  // namespace sandstroke
