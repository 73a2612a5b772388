#pragma once

#include <cstdint>
#include <optional>

#include "record/switch_press.h"

namespace sandstroke {

/// When a recording begins: once all that is asked for has happened, in this order.
struct StartSettings {
  double countdown = 0.0;           ///< s
  std::optional<int> start_switch;  ///< (from 0, to 31) is pressed
  bool at_contact = false;          ///< the tool has been out of the sand, and then touches it
  bool at_once() const { return countdown <= 0.0 && !start_switch && !at_contact; }
};

/// The event that a recorder waits for.
enum class Awaited {
  nothing,
  countdown,
  start_switch,
  lift,    ///< the tool must be out of the sand, before the recording begins or a force is given
  contact  ///< the tool must touch the sand
};

/// Says when a recording begins, reading by reading.
class StartGate {
 public:
  /// countdown_end, debounce [ns]. debounce: as in SwitchPress.
  StartGate(const StartSettings& settings, std::int64_t countdown_end, std::int64_t debounce);

  /// Takes a reading at `now` [ns] and says what is still awaited. Times increase. touches: the tool touches
  /// the sand.
  Awaited see(std::int64_t now, std::uint32_t switches, bool touches) noexcept;

 private:
  std::int64_t countdown_end_;
  std::optional<SwitchPress> press_;  // none: it was pressed, or none is asked for
  bool at_contact_, lifted_ = false;
};

}  // namespace sandstroke
