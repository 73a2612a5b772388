#pragma once

#include <optional>

#include "sim/tick_loop.h"

namespace sandstroke {

/// A run that somebody else drives, tick by tick: a controller, an optimiser, a learner. With the hand of a
/// stroke, its velocities and its lifts it has the same bits as Simulation.
class SteppedSimulation {
 public:
  /// relaxes: sand relaxes as the scene says (relaxation.rate, way); else only where relax() is called.
  /// Error: input, where device.drag is implicit: it knows where the hand goes in the tick.
  SteppedSimulation(const Scene& scene, HeightField bed, bool relaxes = true);

  const Scene& scene() const { return loop_.scene(); }
  const HeightField& bed() const { return loop_.bed(); }
  /// s, of the next tick.
  double time() const;

  /// The hand is there now. velocity [m/s]: none: by the way since the tick before. turns: the tool with the
  /// hand. What the device felt; with device.model = "dynamic" it has gone from where it was while the hand
  /// went here. Error: input, where a number is none; unstable.
  const TickRecord& tick(Hand hand, bool knows_velocity, bool turns);
  /// Sand relaxes to rest; the tool stays where it is. After the last tick, lift() first.
  RelaxationOutcome relax(const PassWatcher& watcher = {}) { return loop_.relax(watcher); }
  void lift() { loop_.lift(); }

 private:
  TickLoop loop_;
  bool relaxes_;
  std::int64_t ticks_ = 0;
  std::optional<TickRecord> last_;  // not advanced yet: where the hand goes in it is known with the next one
};

}  // namespace sandstroke
