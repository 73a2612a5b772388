#include <spdlog/fmt/fmt.h>

#include "cli/record_parts.h"
#include "cli/standard_output.h"
#include "record/recording_json.h"

namespace sandstroke {
namespace {

std::string force_text(const RecordingHeader& header, const TickCounts& ticks) {
  const double limit = header.force_limit;
  if (limit == 0.0) return "none";
  if (!header.device.hand_feels) return "the model's, which a device would give; no hand felt it";
  std::string text = limit < any_force ? fmt::format("up to {:.3g} N", limit) : "no limit";
  if (ticks.interlocked > 0)
    text += fmt::format("; none in {} ticks, until the tool was lifted out of the sand", ticks.interlocked);
  if (ticks.ramped > 0) text += fmt::format("; still fading in during {} ticks", ticks.ramped);
  if (ticks.clamped > 0) text += fmt::format(", cut to the limit in {}", ticks.clamped);
  if (ticks.rate_limited > 0) text += fmt::format(", its change limited in {}", ticks.rate_limited);
  if (ticks.refused > 0) text += fmt::format(", not finite in {}", ticks.refused);
  return text;
}

std::string sand_text(const LiveSandReport& felt) {
  return fmt::format(
      "touched in {} ticks, relaxed {} times, {}{}", felt.contact_ticks, felt.relaxation.relaxations,
      felt.relaxation.converged ? "at rest" : "still relaxing at the end",
      felt.deferred_ticks > 0
          ? fmt::format("; in {} ticks the tool displaced no sand, because relaxation was late",
                        felt.deferred_ticks)
          : "");
}

double seconds(const RecordingReport& report) {
  return static_cast<double>(report.footer.ticks.elapsed) / report.header.nominal_rate;
}

}  // namespace

std::string scheduling_text(const Scheduling& scheduling) {
  return fmt::format("{}{}, memory {}locked", scheduling.policy,
                     scheduling.priority > 0 ? fmt::format(" {}", scheduling.priority) : "",
                     scheduling.memory_locked ? "" : "not ");
}

std::string ticks_text(const TickCounts& ticks) {
  if (ticks.recorded == ticks.elapsed) return fmt::format("{}, all recorded", ticks.elapsed);
  std::string text = fmt::format("{}: {} recorded", ticks.elapsed, ticks.recorded);
  if (ticks.skipped > 0) text += fmt::format(", {} skipped (the loop was late)", ticks.skipped);
  if (ticks.unread > 0) text += fmt::format(", {} unread (the device sent no data)", ticks.unread);
  if (ticks.dropped > 0) text += fmt::format(", {} dropped (the disk was too slow)", ticks.dropped);
  return text;
}

std::string lateness_text(const RecordingFooter& footer) {
  return fmt::format(
      "{:.0f} us on average, 99 % within {:.0f} us, {:.0f} us at most; {} samples were over half a tick late",
      1e6 * footer.lateness.mean, 1e6 * footer.lateness.p99, 1e6 * footer.lateness.max, footer.ticks.late);
}

void print_recording(const RecordingReport& report, const std::optional<LiveSandReport>& felt,
                     const std::filesystem::path& file, bool json) {
  const RecordingHeader& header = report.header;
  const RecordingFooter& footer = report.footer;
  if (json) {
    nlohmann::ordered_json object = {
        {"output", file.string()}, {"complete", is_complete(footer.reason)}, {"seconds", seconds(report)}};
    object.update(as_json(footer));
    object.update(as_json(header));
    object.erase("felt_scene");  // a long text, which the file contains
    if (felt)
      object["felt"] = {{"contact_ticks", felt->contact_ticks},
                        {"held_ticks", felt->deferred_ticks},
                        {"relaxations", felt->relaxation.relaxations},
                        {"passes", felt->relaxation.passes},
                        {"converged", felt->relaxation.converged}};
    print_json(object);
    return;
  }
  print_row("stroke", file.string());
  print_row("device", header.source);
  print_row("time", fmt::format("{:.3f} s at {:.6g} Hz; {}", seconds(report), header.nominal_rate,
                                stop_reason_text(footer.reason)));
  print_row("ticks", ticks_text(footer.ticks));
  print_row("lateness", lateness_text(footer));
  print_row("scheduling", scheduling_text(header.scheduling));
  print_row("force", force_text(header, footer.ticks));
  if (felt) print_row("sand", sand_text(*felt));
}

}  // namespace sandstroke
