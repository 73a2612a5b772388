#pragma once

#include <optional>

namespace sandstroke {

/// What must be before a hand gets a force. A stylus in its inkwell, or an arm that has sunk, lies deep in
/// the sand while its user is still at the keyboard; after a gap nobody knows where the hand is. So no force
/// is given until the tool has been out of the sand: until the world asked for (almost) none for a while
/// without interruption, for drivers give out a first reading of zeros.
class Interlock {
 public:
  static constexpr double least_force = 0.2;      ///< N: what is due below it counts as none
  static constexpr double longest_pause = 0.025;  ///< s between readings: beyond it closes

  /// clear_time [s]: for how long the tool must be out of the sand.
  explicit Interlock(double clear_time) : clear_time_(clear_time) {}

  /// A reading at `time` [s], by which so large a force is due [N]; times increase.
  void see(double time, double force_due) noexcept;
  /// Whatever cut the force: a device that gave or took nothing, a force that was no number.
  void close() noexcept;
  bool is_open() const noexcept { return open_since_.has_value(); }
  /// s, of the last reading, since it opened; 0 while it is closed.
  double open_for() const noexcept { return open_since_ ? *seen_ - *open_since_ : 0.0; }

 private:
  double clear_time_;
  std::optional<double> seen_, clear_since_, open_since_;  // s
};

}  // namespace sandstroke
