#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "core/stopwatch.h"
#include "sim/idle_ticks.h"
#include "sim/run_result.h"
#include "sim/sand_follower.h"
#include "sim/scene.h"
#include "sim/simulation_observer.h"
#include "sim/tick_loop.h"

namespace sandstroke {

/// How a run keeps its state between ticks, and goes on from one. Both need a stroke or a source.
struct Checkpoints {
  std::string from = {};           ///< a state to go on from; empty: it begins at the start
  std::function<bool()> due = {};  ///< asked after each tick; empty: no state is kept
  std::function<void(std::string state)> keep = {};
};

/// Runs the tick loop: hand, device, level, depth and force, displacement, and relaxation at its own rate.
/// After the stroke, sources go on until the last one stops and all its sand has landed; one without a stop
/// stops with the stroke. At the end the bed is relaxed to equilibrium. Idle ticks take no time, and neither
/// they nor those after the stroke are reported; otherwise all is as if they were played.
class Simulation {
 public:
  /// stroke: as place_stroke() returns it; none: the bed is only relaxed. relaxer: none: as the scene says.
  /// Error: input, if the stroke may enter sand outside the bed (where it is below the surface's highest
  /// possible point), or if stroke or sources have 1e15 ticks or more.
  Simulation(const Scene& scene, HeightField bed, std::optional<Stroke> stroke,
             std::unique_ptr<Relaxer> relaxer = nullptr);

  const Scene& scene() const { return loop_.scene(); }
  const HeightField& bed() const { return loop_.bed(); }
  /// The bed as it is shown while a stroke goes on: at rest (TickLoop::bed_at_rest), once it has relaxed.
  const HeightField& shown_bed() { return result_.relaxations > 0 ? loop_.bed_at_rest() : bed(); }
  /// The sand on the tool; none: there is none.
  std::optional<LoadSurface> load_surface() const { return loop_.load_surface(); }
  /// The number of ticks that run() reports: all of the stroke but idle ones.
  std::int64_t told_ticks() const;
  TraceContent trace_content() const;
  /// Until sources stop, those of a run without a stroke, too [s].
  double seconds() const;
  double stroke_seconds() const { return stroke_ ? stroke_->stroke().duration() : 0.0; }

  /// Runs once, to the end or until interrupted(). From a state it has the bits of the run that kept it, and
  /// so have the observers, which must be of the same kinds. Error: unstable, if force or device leave all
  /// bounds; input, if the state is of another scene, or where a plugin law has a part in one.
  RunResult run(const Observers& observers = {}, const Checkpoints& checkpoints = {});

 private:
  /// Begins the run, or goes on from a state.
  void begin(const std::string& state);
  void run_stroke(const Checkpoints& checkpoints);
  /// Plays the sources' ticks after the stroke.
  void run_sources(const Checkpoints& checkpoints);
  /// What ends the ticks until next_tick_.
  void end_tick(const Checkpoints& checkpoints);
  void visit_state(StateVisitor& state);
  /// The stages of the tick at whose end the stroke is at next_time (TickLoop::step).
  TickRecord tick(double time, const Hand& hand, double next_time, const std::function<void()>& relax);
  /// The stroke's hand at that time of the stroke, on the sand as it lies now.
  Hand hand_at(double time);
  /// Adds a tick to the result.
  void account_load(const TickRecord& record);
  void account(const TickRecord& record);
  /// Plays idle ticks: relaxes sand that is not at rest when that is due, and keeps frames. Returns the tick
  /// after the last one.
  std::int64_t idle(const TickRange& ticks);
  /// A tick without a hand, in which sources pour.
  void pour(std::int64_t tick);
  RelaxationOutcome relax(double time);
  void keep_frame(double time);
  template <class Event>
  void tell(const Event& event) {
    for (SimulationObserver* observer : observers_) event(*observer);
  }

  TickLoop loop_;
  std::optional<StrokeSampler> stroke_;
  std::optional<SandFollower> follower_;
  std::int64_t ticks_ = 0;      // of the stroke
  std::int64_t all_ticks_ = 0;  // of stroke and sources, but for what is in the air at the end
  std::vector<TickRange> idle_;
  std::int64_t next_tick_ = 0, next_idle_ = 0;  // the first one of each that is not played
  Hand hand_;                                   // at the next tick's start
  Stopwatch watch_;
  double seconds_before_ = 0.0;  // of the run that kept the state
  Observers observers_;
  std::optional<Eigen::Vector3d> slow_velocity_;  // m/s, of a tool with sand on it
  RunResult result_;
};

/// Whether the sand returned more energy than it took, by more than rounding and a force held for a tick do:
/// a fraction of 1e-3.
bool returned_energy(const DeviceResult& result);

/// Whether returned_energy() is true and the loop may be to blame, because it was not passive throughout. A
/// passive loop, too, may return a little, which its dampers take, or lift the tool on sand that rises under
/// it.
bool loop_returned_energy(const DeviceResult& result, const DeviceSettings& device);

}  // namespace sandstroke
