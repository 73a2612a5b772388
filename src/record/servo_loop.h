#pragma once

#include <atomic>
#include <optional>

#include "haptics/recording.h"
#include "record/force_guard.h"
#include "record/lateness_histogram.h"
#include "record/loop_clock.h"
#include "record/spsc_ring.h"
#include "record/stop_switch.h"

namespace sandstroke {

struct ServoSettings {
  double rate = 1000.0;            ///< Hz
  std::optional<double> duration;  ///< s: round(duration x rate) ticks elapse
  ForceLimits force;
  std::optional<int> stop_switch;  ///< the switch (from 0, to 31) that ends the recording when it is pressed
  double debounce = 0.02;          ///< s that it must be down for; and up once before, to count at all
  /// s for which the device may go on giving no reading (or taking no force), or the world no number, before
  /// the loop stops (device_lost, no_number). Until then no force is given: what fails once costs a tick, not
  /// the recording; what goes on failing is not hidden.
  double silence = 0.1;
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
/// Ticks to which it comes a whole tick late or more are counted and skipped, never made up in a burst; it
/// goes on at once with the tick in which it woke, whose sample says the true time. In it nothing is
/// allocated, locked, written or thrown. Whatever ends it, the last command is zero force.
class ServoLoop {
 public:
  /// The device is open. world: none, where no force is to be given.
  ServoLoop(HapticDevice& device, FeltWorld* world, LoopClock& clock, SpscRing<RecordedSample>& ring,
            const ServoSettings& settings);

  /// N: what the hand may get, at most: the smaller of the limit set and the device's; 0 without a world.
  double force_limit() const { return force_limit_; }
  /// Until one of its own reasons, or stop(). Once. The first tick is now; one that lies at the end of the
  /// device's duration() is the last (round(duration x rate) + 1 ticks).
  RecordingFooter run() noexcept;

  // From any thread:
  /// The first reason given holds. Also before run().
  void stop(StopReason reason) noexcept;
  ServoProgress progress() const noexcept;
  /// The loop's time of its last sign of life [ns]; 0 before the first and after the last.
  std::int64_t heartbeat() const noexcept { return heartbeat_.load(std::memory_order_acquire); }

 private:
  struct Fault {
    std::int64_t limit;  // ns that it may last
    StopReason reason;   // to stop after that
    std::optional<std::int64_t> since;
  };
  bool stopped() const noexcept { return reason_.load() != going_on; }
  std::int64_t tick_time(std::int64_t tick) const noexcept;
  std::int64_t wait_for_tick() noexcept;
  /// Those whose time has passed, up to the last one.
  void skip_ticks_before(std::int64_t now) noexcept;
  void serve_tick(std::int64_t now) noexcept;
  /// What fails, from tick to tick, stops the loop in the end.
  void stop_where_it_lasts(bool fails, Fault& fault, std::int64_t now) noexcept;
  bool read(double time, DeviceReading& reading) noexcept;
  FeltForce feel(std::int64_t now, const DeviceReading& reading) noexcept;
  bool command(const Eigen::Vector3d& force) noexcept;
  void keep(const DeviceReading& reading, std::int64_t now, std::uint32_t flags) noexcept;
  void publish(std::int64_t now) noexcept;

  HapticDevice& device_;
  FeltWorld* world_;
  LoopClock& clock_;
  SpscRing<RecordedSample>& ring_;
  double rate_;
  std::int64_t last_tick_;
  StopReason end_reason_;  // after the last tick
  bool gives_force_;
  double force_limit_;
  ForceGuard guard_;
  std::optional<StopSwitch> stop_switch_;

  // The loop's own while it runs:
  std::int64_t start_ = 0;                          // ns
  Fault silent_, wrong_;                            // the device, the world
  std::uint64_t expected_ = 0;                      // sequence number, where nothing is missing
  Eigen::Vector3d held_ = Eigen::Vector3d::Zero();  // N, by the device
  TickCounts ticks_;
  LatenessHistogram lateness_;

  // Seen by others:
  static constexpr int going_on = -1;
  std::atomic<int> reason_{going_on};
  std::atomic<std::int64_t> heartbeat_{0};
  std::atomic<std::int64_t> elapsed_{0}, recorded_{0}, time_{0}, late_{0}, max_late_{0};  // ns from time_ on
  std::atomic<double> force_{0.0};
};

}  // namespace sandstroke
