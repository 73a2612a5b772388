#pragma once

#include <algorithm>
#include <functional>
#include <utility>

#include "haptics/recording.h"
#include "record/felt_force.h"
#include "record/loop_clock.h"

namespace sandstroke {

/// Time that moves only by what is slept, and by what a test adds.
class FakeClock : public LoopClock {
 public:
  std::int64_t now() noexcept override { return time_; }
  void sleep_until(std::int64_t time) noexcept override { time_ = time > time_ ? time : time_ + past_sleep; }
  void add(std::int64_t time) { time_ += time; }
  std::int64_t past_sleep = 0;  ///< ns: who sleeps until a time that has passed gives the core to others

 private:
  std::int64_t time_ = 1'234'567'890'123;  // ns
};

/// A device with faults as a test injects them. It moves along x with the time, at 1 m/s.
class FakeDevice : public HapticDevice {
 public:
  DeviceSpecification description;
  std::optional<double> length;                             ///< s, its duration()
  std::function<bool(double, DeviceReading&)> reads;        ///< after it was read: false = it gave nothing
  std::function<bool(const Eigen::Vector3d&)> takes_force;  ///< false = it took nothing

  Eigen::Vector3d held = Eigen::Vector3d::Zero();  ///< N, what its motors give
  std::optional<bool> is_right = true;             ///< is_calibrated(), unless it was calibrated here
  int opened = 0, calibrated = 0, commands = 0, released = 0, closed = 0;

  void open() override { ++opened; }
  void calibrate() override { ++calibrated; }
  const DeviceSpecification& specification() const override { return description; }
  std::optional<bool> is_calibrated() const override { return calibrated > 0 ? true : is_right; }
  std::optional<double> duration() const override { return length; }
  bool read(double time, DeviceReading& reading) noexcept override {
    reading.position = {time, 0.0, 0.0};
    return !reads || reads(time, reading);
  }
  bool command(const Eigen::Vector3d& force) noexcept override {
    ++commands;
    if (takes_force && !takes_force(force)) return false;
    held = force;
    return true;
  }
  void release() noexcept override {
    ++released;
    held.setZero();
  }
  void close() noexcept override { ++closed; }
};

/// A world whose force is what a test says.
class FakeWorld : public FeltWorld {
 public:
  explicit FakeWorld(std::function<FeltForce(double)> force) : force_(std::move(force)) {}
  FeltForce feel(double time, const DeviceReading&) noexcept override { return force_(time); }
  bool touches(const DeviceReading& reading) noexcept override { return reading.position.z() < 0.0; }

 private:
  std::function<FeltForce(double)> force_;
};

}  // namespace sandstroke
