#pragma once

#include <optional>

namespace sandstroke {

/// Withholds forces until the tool has been out of the sand. A stylus in its inkwell, or an arm that has
/// sunk, lies deep in the sand while its user is still at the keyboard; after a gap nobody knows where the
/// hand is. "Out" means that the world asked for (almost) no force for a while without interruption, because
/// drivers may first give a reading of zeros.
class Interlock {
 public:
  static constexpr double least_force = 0.2;      ///< N: a smaller force due counts as none
  static constexpr double longest_pause = 0.025;  ///< s between readings; a longer pause closes the interlock

  /// clear_time [s]: how long the tool must be out of the sand.
  explicit Interlock(double clear_time) : clear_time_(clear_time) {}

  /// Takes a reading at `time` [s] with the force due there [N]. Times increase.
  void see(double time, double force_due) noexcept;
  /// Call it when something cut the force: a device that gave or took nothing, a force that was no number.
  void close() noexcept;
  bool is_open() const noexcept { return open_since_.has_value(); }
  /// s from its opening to the last reading; 0 while it is closed.
  double open_for() const noexcept { return open_since_ ? *seen_ - *open_since_ : 0.0; }

 private:
  double clear_time_;
  std::optional<double> seen_, clear_since_, open_since_;  // s
};

}  // namespace sandstroke
