#include "record/recorder.h"

#include <spdlog/fmt/chrono.h>
#include <spdlog/spdlog.h>

#include <chrono>
#include <cmath>
#include <ctime>
#include <exception>
#include <utility>

#include "core/error.h"
#include "record/journal.h"
#include "record/sample_writer.h"
#include "record/watchdog.h"

namespace sandstroke {
namespace {

/// Keeps a device open as long as this object lives.
class OpenDevice {
 public:
  explicit OpenDevice(HapticDevice& device) : device_(device) { device_.open(); }
  OpenDevice(const OpenDevice&) = delete;
  ~OpenDevice() {
    device_.release();
    device_.close();
  }

 private:
  HapticDevice& device_;
};

/// use: "start" or "stop".
void check_switch(const char* use, std::optional<int> number, const DeviceSpecification& device) {
  const int most = device.switches > 0 ? std::min(device.switches, 32) : 32;  // 0: it does not say
  if (number && (*number < 0 || *number >= most)) {
    throw_input_error("{} switch {}: {} has the switches 0 to {}; choose one of them", use, *number,
                      device.model, most - 1);
  }
}

/// Checks the calibration: wrong positions would give wrong forces.
void check_calibrated(const HapticDevice& device, const FeltWorld* world, const RecorderSettings& settings) {
  const std::optional<bool> calibrated = device.is_calibrated();
  const std::string& model = device.specification().model;
  const bool gives_force =
      world && settings.servo.force.max_force > 0.0 && device.specification().max_force > 0.0;
  if (calibrated == false && gives_force && !settings.allow_uncalibrated)
    throw_input_error(
        "the haptic device {} is not calibrated, so its positions and forces may be wrong; calibrate it with "
        "--calibrate (which may move its arm), record without --feel, or give forces anyway with "
        "--allow-uncalibrated",
        model);
  if (calibrated == false)
    spdlog::warn(
        "the haptic device {} is not calibrated, so its positions may be wrong; calibrate it with "
        "--calibrate",
        model);
  if (!calibrated && gives_force)
    spdlog::warn(
        "the driver does not say whether the haptic device {} is calibrated; calibrate it as its manual "
        "describes (a Touch in its inkwell)",
        model);
}

std::string utc_now() {
  using namespace std::chrono;
  const auto now = duration_cast<milliseconds>(system_clock::now().time_since_epoch()).count();
  return fmt::format("{:%Y-%m-%dT%H:%M:%S}.{:03}Z", fmt::gmtime(static_cast<std::time_t>(now / 1000)),
                     now % 1000);
}

}  // namespace

RecordingReport record(HapticDevice& device, FeltWorld* world, const RecorderSettings& settings,
                       RecordingHeader header, const std::filesystem::path& journal,
                       const RecordingWatcher& watcher) {
  const OpenDevice open(device);
  check_switch("start", settings.servo.start.start_switch, device.specification());
  check_switch("stop", settings.servo.stop_switch, device.specification());
  if (settings.calibrate) device.calibrate();
  check_calibrated(device, world, settings);

  MonotonicClock clock;
  SpscRing<RecordedSample> ring(static_cast<std::size_t>(std::ceil(settings.ring * settings.servo.rate)));
  ServoLoop loop(device, world, clock, ring, settings.servo);
  LoopThread thread(loop, settings.priority, settings.lock_memory);

  header.device = device.specification();
  header.nominal_rate = settings.servo.rate;
  header.scheduling = thread.scheduling();
  header.force_limit = loop.force_limit();
  header.started = utc_now();
  header.started_monotonic = to_seconds(clock.now());
  JournalWriter file(journal, header);
  SampleWriter writer(ring, file, loop);
  std::optional<Watchdog> watchdog;
  if (loop.force_limit() > 0.0) watchdog.emplace(loop, device, clock, settings.watchdog, settings.priority);

  thread.start();
  std::exception_ptr failure;
  try {
    thread.watch(watcher, settings.watch);
  } catch (...) {
    failure = std::current_exception();
    loop.stop(StopReason::error);
  }
  RecordingReport report{std::move(header), thread.footer(), {}};
  try {
    writer.finish();
    file.finish(report.footer);
  } catch (const Error& error) {
    // Samples that the loop put into the ring and are not in the file count as dropped, as if it had been
    // full.
    TickCounts& ticks = report.footer.ticks;
    ticks.dropped += ticks.recorded - file.samples();
    ticks.recorded = file.samples();
    report.footer.reason = StopReason::disk;
    report.disk_error = error.what();
  }
  if (failure) std::rethrow_exception(failure);
  return report;
}

}  // namespace sandstroke
