#include "record/start_gate.h"

namespace sandstroke {

StartGate::StartGate(const StartSettings& settings, std::int64_t countdown_end, std::int64_t debounce)
    : countdown_end_(countdown_end), at_contact_(settings.at_contact) {
  if (settings.start_switch) press_.emplace(*settings.start_switch, debounce);
}

Awaited StartGate::see(std::int64_t now, std::uint32_t switches, bool touches) noexcept {
  if (now < countdown_end_) return Awaited::countdown;
  if (press_) {
    if (!press_->pressed(switches, now)) return Awaited::start_switch;
    press_.reset();
  }
  if (!at_contact_ || (lifted_ && touches)) return Awaited::nothing;
  lifted_ = lifted_ || !touches;
  return lifted_ ? Awaited::contact : Awaited::lift;
}

}  // namespace sandstroke
