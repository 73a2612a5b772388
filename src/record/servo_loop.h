#pragma once

#include <atomic>
#include <optional>

#include "haptics/recording.h"
#include "record/force_guard.h"
#include "record/lateness_histogram.h"
#include "record/loop_clock.h"
#include "record/spsc_ring.h"

namespace sandstroke {

struct ServoSettings {
  double rate = 1000.0;            ///< Hz
  std::optional<double> duration;  ///< s
  ForceLimits force;
  std::optional<int> stop_switch;  ///< the switch (from 0) that ends the recording when it is pressed
  double debounce = 0.02;          ///< s that it must be down for; and up once before, to count at all
  double silence = 0.1;            ///< s without a reading: the device is taken for lost
};

/// How far a loop is; any thread may look.
struct ServoProgress {
  double time = 0.0;  ///< s, since the first tick
  std::int64_t elapsed = 0, recorded = 0;
  double force = 0.0;     ///< N, magnitude commanded last
  double lateness = 0.0;  ///< s, of the last tick
  double max_lateness = 0.0;
};

/// The 1 kHz loop: at absolute times, reads the device, feels, commands, and puts a sample into the ring.
/// Ticks whose time has passed are counted and skipped, never made up in a burst. In it nothing is allocated,
/// locked, written or thrown. Whatever ends it, the last command is zero force.
class ServoLoop {
 public:
  /// The device is open. world: none, where no force is to be given.
  ServoLoop(HapticDevice& device, FeltWorld* world, LoopClock& clock, SpscRing<RecordedSample>& ring,
            const ServoSettings& settings);

  /// Until one of its own reasons, or stop(). Once.
  RecordingFooter run() noexcept;

  // From any thread:
  /// The first reason given holds.
  void stop(StopReason reason) noexcept;
  ServoProgress progress() const noexcept;
  /// The loop's time of its last sign of life [ns]; 0 before the first.
  std::int64_t heartbeat() const noexcept { return heartbeat_.load(std::memory_order_acquire); }

 private:
  // (as the implementation needs)
  std::atomic<std::int64_t> heartbeat_{0};
};

}  // namespace sandstroke
