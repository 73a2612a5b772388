#pragma once

#include <array>
#include <atomic>
#include <limits>
#include <optional>
#include <string>

#include "haptics/recording.h"
#include "record/force_guard.h"
#include "record/lateness_histogram.h"
#include "record/loop_clock.h"
#include "record/spsc_ring.h"
#include "record/start_gate.h"

namespace sandstroke {

struct ServoSettings {
  double rate = 1000.0;            ///< Hz
  std::optional<double> duration;  ///< s: round(duration x rate) ticks elapse
  ForceLimits force;
  StartSettings start;
  StopReason switch_reason = StopReason::stop_switch;  ///< what pressing it means
  std::optional<int> stop_switch;  ///< the switch (from 0, to 31) that ends the recording when it is pressed
  double debounce = 0.02;          ///< s that a switch must be down to count, after it was up once
  /// s that the device may give no reading (or take no force), or the world no number, before the loop stops
  /// (device_lost, no_number). Until then no force is given. A single failure costs a tick, not the
  /// recording; a lasting failure is not hidden.
  double silence = 0.1;
};

/// How far a loop is; any thread may look.
struct ServoProgress {
  double time = 0.0;  ///< s, since the first tick; before it, since the countdown's end
  std::int64_t elapsed = 0, recorded = 0;
  double force = 0.0;     ///< N, magnitude commanded last
  double lateness = 0.0;  ///< s, of the last tick
  double max_lateness = 0.0;
  // For display. The axes may come from different ticks.
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< m, as read last, in the device's frame
  Eigen::Vector3d held = Eigen::Vector3d::Zero();      ///< N, commanded last, in the device's frame
  bool read = false;                                   ///< the device gave a position in the last tick
  /// Before the first tick: what the loop waits for. After it: `lift`, while no force is given because the
  /// tool must first be lifted out of the sand.
  Awaited awaited = Awaited::nothing;
};

/// The text of what the user must do or wait for: "lift the tool out of the sand to begin"; empty: nothing.
std::string hint_of(const ServoProgress& progress);

/// The 1 kHz loop. At absolute times it reads the device, feels, commands, and puts a sample into the ring.
/// Ticks to which it comes a whole tick late or more are counted and skipped, never made up in a burst. It
/// goes on at once with the tick in which it woke, whose sample has the true time. The loop allocates, locks,
/// writes and throws nothing. Whatever ends it, the last command is zero force.
class ServoLoop {
 public:
  /// The device must be open. world: null, where no force is to be given.
  ServoLoop(HapticDevice& device, FeltWorld* world, LoopClock& clock, SpscRing<RecordedSample>& ring,
            const ServoSettings& settings);

  /// The most that the hand may get [N]: the smaller of the limit set and the device's; 0 without a world.
  double force_limit() const { return force_limit_; }
  /// Runs until one of its own reasons, or stop(). Call it once. The first tick is now, or when all that
  /// settings.start asks for has happened. Until then the device is read, and nothing is felt, displaced or
  /// recorded. Where the start is at contact, tick 0 is the one before it, so the way into the sand is in the
  /// stroke. A stand-in for a hand moves from the countdown's end on. The tick at the end of its duration()
  /// is the last (round(duration x rate) + 1 ticks of all of it).
  RecordingFooter run() noexcept;

  // Called from any thread:
  /// The first reason given counts. It may also be called before run().
  void stop(StopReason reason) noexcept;
  ServoProgress progress() const noexcept;
  /// The loop's time at its last sign of life [ns]; 0 before the first and after the last.
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
  void await_start() noexcept;
  /// Begins tick 0 at `now` [ns]. before: the reading of that tick, if the tick is over.
  void begin(std::int64_t now, const DeviceReading* before) noexcept;
  /// Skips the ticks whose time has passed, up to the last one.
  void skip_ticks_before(std::int64_t now) noexcept;
  void serve_tick(std::int64_t now) noexcept;
  /// Stops the loop where a failure lasts from tick to tick.
  void stop_where_it_lasts(bool fails, Fault& fault, std::int64_t now) noexcept;
  bool read(std::int64_t now, DeviceReading& reading) noexcept;
  FeltForce feel(std::int64_t now, const DeviceReading& reading) noexcept;
  bool command(const Eigen::Vector3d& force) noexcept;
  void keep(const DeviceReading& reading, std::int64_t now, std::uint32_t flags) noexcept;
  void publish(std::int64_t now) noexcept;
  void publish_hand() noexcept;
  void publish_waiting(std::int64_t time, Awaited awaited) noexcept;

  HapticDevice& device_;
  FeltWorld* world_;
  LoopClock& clock_;
  SpscRing<RecordedSample>& ring_;
  ServoSettings settings_;
  double rate_;
  bool gives_force_;
  std::uint32_t always_flagged_;  // SampleFlag
  double force_limit_;
  ForceGuard guard_;
  std::optional<SwitchPress> stop_switch_;

  // Only the loop uses these while it runs:
  std::int64_t awake_ = 0;        // ns: the loop's start,
  std::int64_t played_from_ = 0;  // the device's time 0,
  std::int64_t start_ = 0;        // the recording's time 0
  std::int64_t last_tick_ = std::numeric_limits<std::int64_t>::max();
  StopReason end_reason_ = StopReason::duration;    // after the last tick
  Fault silent_, wrong_;                            // the device, the world
  std::uint64_t expected_ = 0;                      // the next sequence number, where nothing is missing
  Eigen::Vector3d held_ = Eigen::Vector3d::Zero();  // N, held by the device
  bool refuses_ = false;                            // the device has taken no command since one it refused
  Eigen::Vector3d position_ = Eigen::Vector3d::Zero();  // m, as read last
  bool read_ = false;                                   // in this tick
  TickCounts ticks_;
  LatenessHistogram lateness_;

  // Other threads read these:
  static constexpr int going_on = -1;
  std::atomic<int> reason_{going_on};
  std::atomic<std::int64_t> heartbeat_{0};
  std::atomic<std::int64_t> elapsed_{0}, recorded_{0}, time_{0}, late_{0}, max_late_{0};  // ns from time_ on
  std::atomic<double> force_{0.0};
  std::array<std::atomic<double>, 3> seen_position_{}, seen_force_{};  // m, N
  std::atomic<bool> seen_read_{false};
  std::atomic<Awaited> awaited_{Awaited::nothing};
};

}  // namespace sandstroke
