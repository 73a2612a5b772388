#include <spdlog/spdlog.h>

#include "cli/record_parts.h"
#include "cli/standard_output.h"
#include "core/interrupt.h"
#include "core/progress.h"
#include "record/felt_loop_text.h"
#include "record/loop_check.h"
#include "record/recording_json.h"

namespace sandstroke {
namespace {

constexpr int not_fit = 1;

/// Advice for a machine that already gave the requested scheduling.
constexpr const char* other_remedies =
    "close other programs, switch power saving off (cpupower frequency-set -g performance), or lower --rate";

void print_table(const LoopCheck& check, const ServoSettings& servo) {
  print_row("loop", fmt::format("{:.3f} s at {:.6g} Hz",
                                static_cast<double>(check.loop.ticks.elapsed) / servo.rate, servo.rate));
  print_row("scheduling", scheduling_text(check.scheduling));
  print_row("ticks", ticks_text(check.loop.ticks));
  print_row("lateness", lateness_text(check.loop));
  print_row("needed", fmt::format("no tick skipped, and less than {:.0f} us in 99 of 100",
                                  1e6 * fit_lateness / servo.rate));
  const std::string& advice = check.scheduling.advice;
  if (check.fit) {
    print_row("verdict", "fit to record at this rate" +
                             (advice.empty() ? "" : " while nothing else runs; to do better: " + advice));
  } else {
    print_row("verdict", "NOT FIT to record at this rate: " + (advice.empty() ? other_remedies : advice));
  }
}

void print_felt_loop(const FeltLoop& loop, const Scene& scene) {
  print_row("sand", fmt::format("{} at {:.3g} N", felt_sand_text(loop.felt), loop.force));
  print_row("device names", named_text(loop.named));
  print_row("theory allows", felt_sand_text(loop.stable));
  print_row("assumed", assumed_text(loop.device));
  print_row("verdict", verdict_text(loop, scene));
}

nlohmann::ordered_json felt_loop_json(const FeltLoop& loop) {
  const auto sand = [](const FeltSand& felt) {
    return nlohmann::ordered_json{{"stiffness", felt.stiffness}, {"damping", felt.drag}};
  };
  return {{"force", loop.force},
          {"sand", sand(loop.felt)},
          {"device", sand(loop.named)},
          {"theory", sand(loop.stable)},
          {"delay", loop.device.delay},
          {"stable", loop.is_stable()},
          {"within_device", loop.is_within_named()}};
}

}  // namespace

int check_machine(const RecorderSettings& settings, const std::optional<SceneFile>& felt,
                  const DeviceSpecification& device, bool json) {
  const double seconds = settings.servo.duration.value_or(10.0);
  LoopCheck check;
  catch_interrupts();
  {
    Progress bar("check");
    check = check_loop(seconds, settings, [&](const ServoProgress& progress) {
      bar.update(progress.time / seconds);
      return std::nullopt;
    });
  }
  std::optional<FeltLoop> sand;
  if (felt)
    sand = felt_loop(*felt, device, settings.servo.force.max_force, settings.servo.rate,
                     check.loop.lateness.p99);
  if (json) {
    nlohmann::ordered_json object = {{"fit", check.fit},
                                     {"nominal_rate", settings.servo.rate},
                                     {"scheduling", check.scheduling.policy},
                                     {"scheduling_priority", check.scheduling.priority},
                                     {"memory_locked", check.scheduling.memory_locked},
                                     {"scheduling_advice", check.scheduling.advice}};
    object.update(as_json(check.loop));
    if (felt) object["felt"] = sand ? felt_loop_json(*sand) : nlohmann::ordered_json();
    print_json(object);
  } else {
    print_table(check, settings.servo);
    if (sand) print_felt_loop(*sand, *felt);
    if (felt && !sand)
      print_row("sand", "no limit to compare with: there is no force, or the device states no limit");
  }
  if (interrupted()) return 128 + interrupted();
  return check.fit && (!sand || sand->is_stable()) ? 0 : not_fit;
}

}  // namespace sandstroke
