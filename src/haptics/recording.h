#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "haptics/haptic_device.h"

namespace sandstroke {

/// The largest tick count of a recording. Files store counts as doubles, which cannot hold every larger whole
/// number.
inline constexpr std::int64_t most_ticks = std::int64_t{1} << 53;

/// Bits for what was unusual about a sample.
enum SampleFlag : std::uint32_t {
  late_sample = 1,          ///< read more than half a tick after its time
  after_skipped_ticks = 2,  ///< ticks before it were skipped, unread or dropped: more than a tick has passed
  clamped_force = 4,        ///< the force was cut to the limit
  ramped_force = 8,         ///< the force was still being faded in
  rate_limited_force = 16,  ///< the force was kept from jumping
  refused_force = 32,       ///< the force was no number: none was given
  deferred_sand = 64,       ///< the tool did not displace, because the relaxing bed was too far behind
  interlocked_force = 128,  ///< no force: the tool had not left the sand since a beginning
  unfelt_force = 256,       ///< the force is the model's: the hand was a pointer, which feels none
};

/// Added to the name of STROKE.h5 for the journal that is written while it is recorded.
inline constexpr const char* journal_extension = ".recording";

/// One servo tick, as recorded. Plain bytes: ring and journal store it as it is.
struct RecordedSample {
  std::uint64_t sequence = 0;  ///< the tick's number; missing numbers are lost ticks
  std::int64_t time = 0;       ///< ns, monotonic clock, right before the device was read
  double position[3] = {};     ///< m, as read, in the device's frame
  double velocity[3] = {};     ///< m/s, as read
  double force[3] = {};        ///< N, last command that was taken, in the device's frame
  std::uint32_t switches = 0;
  std::uint32_t flags = 0;                       ///< SampleFlag
  double orientation[4] = {0.0, 0.0, 0.0, 1.0};  ///< as read: unit quaternion x, y, z, w
};
static_assert(sizeof(RecordedSample) == 128);

/// The scheduling that was asked for a loop that must not wait, as far as the system granted it.
struct Scheduling {
  std::string policy = "SCHED_OTHER";  ///< obtained, as sched(7) names it
  int priority = 0;
  bool memory_locked = false;
  std::string advice;  ///< what a refusal costs, and how to avoid it; empty: nothing was refused
};

/// Data known before the first sample.
struct RecordingHeader {
  DeviceSpecification device;
  std::string source;              ///< the device's name as given: "scripted:wscg.toml"
  std::string started;             ///< wall clock before the first tick, ISO 8601 with ms, UTC ...
  double started_monotonic = 0.0;  ///< s: ... and the clock of the samples' times at that moment
  double nominal_rate = 0.0;       ///< Hz
  Scheduling scheduling;
  double force_limit = 0.0;  ///< N; 0 = no force was given
  std::string felt_scene;    ///< the scene's resolved TOML text, with live sand; else empty
};

/// Counts of ticks: elapsed = recorded + skipped + unread + dropped. If a recording was cut off, it is not
/// known why ticks are missing; all of them count as skipped.
struct TickCounts {
  std::int64_t elapsed = 0;   ///< ticks from the first one on
  std::int64_t recorded = 0;  ///< in the file
  std::int64_t skipped = 0;   ///< their time had passed when the loop woke; never made up
  std::int64_t unread = 0;    ///< the device gave nothing, or no number
  std::int64_t dropped = 0;   ///< the ring was full: the disk did not keep up
  // Recorded ticks, by flag:
  std::int64_t late = 0, clamped = 0, ramped = 0, rate_limited = 0, refused = 0, deferred = 0,
               interlocked = 0;
};

/// The fraction of the elapsed ticks that were skipped.
double skipped_fraction(const TickCounts& ticks);

/// Counts a recorded sample's flags.
void count_flags(std::uint32_t flags, TickCounts& ticks);

/// How long after their time the loop came to its ticks, those included that it skipped for it. NaN if the
/// recording was cut off.
struct Lateness {
  double mean = 0.0, p99 = 0.0, max = 0.0;  ///< s
};

/// Why a recording ended. Only the first four and `finish` (a button on a page) were asked for. cut_off:
/// nothing was left to say why (kill -9, a power failure).
enum class StopReason {
  duration,
  stroke_end,
  stop_switch,
  key,
  signal,
  device_lost,
  stall,
  disk,
  no_number,
  error,
  cut_off,
  finish
};
/// The reason as text, for people and files: "the time was up", ...
const char* stop_reason_text(StopReason reason);
/// The reason with this text; none if no reason has it.
std::optional<StopReason> stop_reason_of(std::string_view text);
/// Whether the recording ended as asked for, and so is complete.
bool is_complete(StopReason reason);

/// Data known after the last sample.
struct RecordingFooter {
  TickCounts ticks;
  Lateness lateness;
  StopReason reason = StopReason::signal;
};
/// Whether over a tenth of the ticks were skipped, so that the samples may not tell what the hand did.
/// Unknown, and so false, if the recording was cut off.
bool is_starved(const RecordingFooter& footer);

/// A recording that is read once, from its beginning. Error: io.
class Recording {
 public:
  virtual ~Recording() = default;
  virtual const RecordingHeader& header() const = 0;
  /// Returns the next samples, at most `most`; none at the end. Sequence and time increase.
  virtual std::vector<RecordedSample> next(std::size_t most) = 0;
  /// To be read after the last sample. None if the recording was cut off.
  virtual const std::optional<RecordingFooter>& footer() const = 0;
};

}  // namespace sandstroke
