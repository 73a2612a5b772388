#pragma once

#include <cstdint>
#include <optional>

namespace sandstroke {

/// The switch of a device that begins or ends a recording. Contacts bounce, and a hand may hold it down
/// before: it counts once it has been seen up, and then been down for a while without interruption.
class SwitchPress {
 public:
  /// number: its bit. debounce [ns]: for how long it must be down.
  SwitchPress(int number, std::int64_t debounce) : number_(number), debounce_(debounce) {}
  /// By a reading's switches at `time` [ns]; times increase.
  bool pressed(std::uint32_t switches, std::int64_t time) noexcept;

 private:
  int number_;
  std::int64_t debounce_;
  bool seen_up_ = false;
  std::optional<std::int64_t> down_since_;
};

}  // namespace sandstroke
