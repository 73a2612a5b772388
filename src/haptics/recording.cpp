#include "haptics/recording.h"

namespace sandstroke {

void count_flags(std::uint32_t flags, TickCounts& ticks) {
  ticks.late += (flags & late_sample) != 0;
  ticks.clamped += (flags & clamped_force) != 0;
  ticks.ramped += (flags & ramped_force) != 0;
  ticks.rate_limited += (flags & rate_limited_force) != 0;
  ticks.refused += (flags & refused_force) != 0;
  ticks.deferred += (flags & deferred_sand) != 0;
  ticks.interlocked += (flags & interlocked_force) != 0;
}

double skipped_fraction(const TickCounts& ticks) {
  return ticks.skipped > 0 ? static_cast<double>(ticks.skipped) / static_cast<double>(ticks.elapsed) : 0.0;
}

bool is_starved(const RecordingFooter& footer) {
  return footer.reason != StopReason::cut_off && skipped_fraction(footer.ticks) > 0.1;
}

const char* stop_reason_text(StopReason reason) {
  switch (reason) {
    case StopReason::duration:
      return "the time was up";
    case StopReason::stroke_end:
      return "the stroke played was over";
    case StopReason::stop_switch:
      return "the stop switch was pressed";
    case StopReason::finish:
      return "Finish was pressed";
    case StopReason::key:
      return "a key was pressed";
    case StopReason::signal:
      return "a signal came";
    case StopReason::device_lost:
      return "the device no longer answered";
    case StopReason::stall:
      return "the loop stood still";
    case StopReason::disk:
      return "the disk took no more";
    case StopReason::no_number:
      return "the force was no number";
    case StopReason::error:
      return "the program failed";
    case StopReason::cut_off:
      return "cut off";
  }
  return "unknown";
}

std::optional<StopReason> stop_reason_of(std::string_view text) {
  for (int i = 0; i <= static_cast<int>(StopReason::finish); ++i)
    if (const auto reason = static_cast<StopReason>(i); text == stop_reason_text(reason)) return reason;
  return std::nullopt;
}

bool is_complete(StopReason reason) { return reason <= StopReason::key || reason == StopReason::finish; }

}  // namespace sandstroke
