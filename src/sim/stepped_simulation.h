#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "sim/tick_loop.h"

namespace sandstroke {

/// The part of a hand's motion that a caller tells with its position.
struct ToldMotion {
  bool velocity = false;     ///< hand.velocity [m/s]; otherwise it follows from the way since the tick before
  bool orientation = false;  ///< hand.orientation: the tool turns with the hand
};

/// A run that the caller drives, tick by tick: a controller, an optimiser, a learner. With the hand of a
/// stroke, its velocities and its lifts it has the same bits as Simulation. Copies go on with the same bits,
/// in any thread. They share the sand that none of them changed, so a copy costs what differs. Error of
/// copying: input, if a plugin law has no copy().
class SteppedSimulation {
 public:
  /// relaxes: sand relaxes as the scene says (relaxation.rate, way); otherwise only when relax() is called.
  /// Error: input, if device.drag is implicit, which must know where the hand goes in the tick.
  SteppedSimulation(const Scene& scene, HeightField bed, bool relaxes = true);

  const Scene& scene() const { return loop_.scene(); }
  const HeightField& bed() const { return loop_.bed(); }
  /// Where the sand of each source is, in the scene's order.
  std::vector<SourceLedger> sources() const {
    return loop_.sources() ? loop_.sources()->ledgers() : std::vector<SourceLedger>();
  }
  /// The sand on the tool; null: it carries none.
  const ToolLoad* load() const { return loop_.load(); }
  /// Time of the next tick [s].
  double time() const;

  /// Plays a tick with the hand at its new position. Returns what the device felt. With device.model =
  /// "dynamic" it has moved from its old position while the hand went here. Error: input, if a number is not
  /// finite; unstable.
  const TickRecord& tick(Hand hand, const ToldMotion& told = {});
  /// Relaxes sand to rest; the tool stays where it is. After the last tick, call lift() first.
  RelaxationOutcome relax(const PassWatcher& watcher = {}) { return loop_.relax(time(), watcher); }
  void lift() { loop_.lift(); }

  /// All that later ticks depend on, as bytes that this build of the library reads. Error: input, if a plugin
  /// law has a part in them.
  std::string state();
  /// Goes on from a state of a simulation of the same scene. Error: input, if it is none: then this
  /// simulation is as it was.
  void set_state(std::string_view state);

 private:
  void visit_state(StateVisitor& state);

  TickLoop loop_;
  bool relaxes_;
  std::int64_t ticks_ = 0;
  std::optional<TickRecord> last_;  // not advanced yet: the next call tells where the hand goes
};

}  // namespace sandstroke
