#pragma once

#include <cstdint>
#include <vector>

#include "core/state_visitor.h"
#include "sand/carried_sand.h"
#include "sand/height_field.h"
#include "sim/run_result.h"

namespace sandstroke {

/// Receives what happens while a simulation runs.
class SimulationObserver {
 public:
  virtual ~SimulationObserver() = default;
  virtual void on_tick(const TickRecord&) {}  ///< every tick but idle ones
  virtual void on_relaxation(const RelaxationRecord&) {}
  /// Called output.frames times a second, first at time 0; then with the bed at rest
  /// (Simulation::shown_bed).
  virtual void on_frame(double /*time*/, const HeightField&) {}
  /// Before a frame where sand lies on the tool.
  virtual void on_load(const LoadSurface&) {}
  /// fraction: the part of the stroke that is done, 0 to 1.
  virtual void on_progress(double /*fraction*/) {}
  /// passes: of the current relaxation, so far.
  virtual void on_pass(std::int64_t /*passes*/, const BedNow& /*bed_now*/) {}
  /// What it knows of the run so far, between ticks: a run that goes on from a state puts it back.
  virtual void visit_state(StateVisitor& /*state*/) {}
};

/// Observers, called in this order. They must outlive the run.
using Observers = std::vector<SimulationObserver*>;

/// Keeps value(tick) of every n-th reported tick, from the first on.
template <class Value>
class Kept : public SimulationObserver {
 public:
  explicit Kept(Value (*value)(const TickRecord&), std::int64_t every = 1) : value_(value), every_(every) {}
  void on_tick(const TickRecord& tick) override {
    if (ticks_++ % every_ != 0) return;
    times.push_back(tick.time);
    values.push_back(value_(tick));
  }
  void visit_state(StateVisitor& state) override {
    state.value("kept.ticks", ticks_);
    state.list("kept.times", times);
    state.list("kept.values", values);
  }
  std::vector<double> times;  // s
  std::vector<Value> values;

 private:
  Value (*value_)(const TickRecord&);
  std::int64_t every_, ticks_ = 0;
};

/// The force on the device in a tick [N].
inline Eigen::Vector3d force_of(const TickRecord& tick) { return tick.device_force; }

}  // namespace sandstroke
