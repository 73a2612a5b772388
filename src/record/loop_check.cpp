#include "record/loop_check.h"

namespace sandstroke {
namespace {

class NoDevice : public HapticDevice {
 public:
  void open() override {}
  void calibrate() override {}
  const DeviceSpecification& specification() const override { return specification_; }
  bool read(double, DeviceReading&) noexcept override { return true; }
  bool command(const Eigen::Vector3d&) noexcept override { return true; }
  void release() noexcept override {}
  void close() noexcept override {}

 private:
  DeviceSpecification specification_;
};

}  // namespace

bool is_fit(const RecordingFooter& loop, double rate) {
  return loop.reason == StopReason::duration && loop.ticks.skipped == 0 &&
         loop.lateness.p99 < fit_lateness / rate;
}

LoopCheck check_loop(double seconds, const RecorderSettings& settings, const RecordingWatcher& watcher) {
  const double rate = settings.servo.rate;
  ServoSettings servo = settings.servo;
  servo.duration = seconds;
  servo.start = {};  // nobody is there to press a switch
  servo.stop_switch.reset();
  NoDevice device;
  MonotonicClock clock;
  SpscRing<RecordedSample> ring(static_cast<std::size_t>(rate) + 1);  // a second's, emptied every 0.1 s
  ServoLoop loop(device, nullptr, clock, ring, servo);
  LoopThread thread(loop, settings.priority, settings.lock_memory);
  thread.start();
  thread.watch([&](const ServoProgress& progress) {
    RecordedSample sample;
    while (ring.pop(sample)) {
    }
    return watcher ? watcher(progress) : std::nullopt;
  });
  const RecordingFooter footer = thread.footer();
  return {thread.scheduling(), footer, is_fit(footer, rate)};
}

}  // namespace sandstroke
