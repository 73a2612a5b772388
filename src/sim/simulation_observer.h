#pragma once

#include <cstdint>
#include <vector>

#include "sand/height_field.h"
#include "sim/run_result.h"

namespace sandstroke {

/// Told what happens while a simulation runs.
class SimulationObserver {
 public:
  virtual ~SimulationObserver() = default;
  virtual void on_tick(const TickRecord&) {}  ///< but for idle ones (idle_ticks.h)
  virtual void on_relaxation(const RelaxationRecord&) {}
  /// output.frames times a second, the first at time 0.
  virtual void on_frame(double /*time*/, const HeightField&) {}
  /// Share of the stroke that is done, 0 to 1.
  virtual void on_progress(double /*fraction*/) {}
  /// Passes of the relaxation that is going on.
  virtual void on_pass(std::int64_t /*passes*/, const BedNow& /*bed_now*/) {}
};

/// Told in this order; they outlive the run.
using Observers = std::vector<SimulationObserver*>;

/// Keeps of every n-th tick that it is told of, from the first on, what value(tick) makes of it.
template <class Value>
class Kept : public SimulationObserver {
 public:
  explicit Kept(Value (*value)(const TickRecord&), std::int64_t every = 1) : value_(value), every_(every) {}
  void on_tick(const TickRecord& tick) override {
    if (ticks_++ % every_ != 0) return;
    times.push_back(tick.time);
    values.push_back(value_(tick));
  }
  std::vector<double> times;  // s
  std::vector<Value> values;

 private:
  Value (*value_)(const TickRecord&);
  std::int64_t every_, ticks_ = 0;
};

/// Of a tick: the force on the device [N].
inline Eigen::Vector3d force_of(const TickRecord& tick) { return tick.device_force; }

}  // namespace sandstroke
