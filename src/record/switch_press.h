#pragma once

#include <cstdint>
#include <optional>

namespace sandstroke {

/// The switch of a device that begins or ends a recording. Switches bounce, and a hand may already hold it
/// down. So a press counts once the switch was seen up, and was then down for a while without interruption.
class SwitchPress {
 public:
  /// number: the switch's bit. debounce [ns]: how long it must be down.
  SwitchPress(int number, std::int64_t debounce) : number_(number), debounce_(debounce) {}
  /// True: pressed, by a reading's switches at `time` [ns]. Times increase.
  bool pressed(std::uint32_t switches, std::int64_t time) noexcept;

 private:
  int number_;
  std::int64_t debounce_;
  bool seen_up_ = false;
  std::optional<std::int64_t> down_since_;
};

}  // namespace sandstroke
