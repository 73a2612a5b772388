#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "haptics/haptic_device.h"

namespace sandstroke {

/// Of a recording: in files counts are doubles, of which not every whole number beyond is one.
inline constexpr std::int64_t most_ticks = std::int64_t{1} << 53;

/// What was out of the ordinary about a sample (bits).
enum SampleFlag : std::uint32_t {
  late_sample = 1,          ///< read more than half a tick after its time
  after_skipped_ticks = 2,  ///< ticks before it were skipped, unread or dropped: more than a tick has passed
  clamped_force = 4,        ///< the force was cut to the limit
  ramped_force = 8,         ///< the force was still being faded in
  rate_limited_force = 16,  ///< the force was held back from jumping
  refused_force = 32,       ///< the force was no number: none was given
  held_sand = 64,           ///< the tool did not dig, for the eroding bed was too far behind
  interlocked_force = 128,  ///< none was given, for the tool had not been out of the sand since a beginning
};

/// What is added to the name of STROKE.h5 while it is being recorded: the name of its journal.
inline constexpr const char* journal_extension = ".recording";

/// One servo tick, as recorded. Plain bytes: it goes through ring and journal as it is.
struct RecordedSample {
  std::uint64_t sequence = 0;  ///< the tick's number: those missing between two samples are gone
  std::int64_t time = 0;       ///< ns, monotonic clock, right before the device was read
  double position[3] = {};     ///< m, as read, in the device's frame
  double velocity[3] = {};     ///< m/s, as read
  double force[3] = {};        ///< N, commanded last (and taken), in the device's frame
  std::uint32_t switches = 0;
  std::uint32_t flags = 0;                       ///< SampleFlag
  double orientation[4] = {0.0, 0.0, 0.0, 1.0};  ///< as read: unit quaternion x, y, z, w
};
static_assert(sizeof(RecordedSample) == 128);

/// What the system gave of what was asked of it, for a loop that must not wait.
struct Scheduling {
  std::string policy = "SCHED_OTHER";  ///< obtained, as sched(7) names it
  int priority = 0;
  bool memory_locked = false;
  std::string advice;  ///< what it costs that something was refused, and how to get it; empty: nothing was
};

/// Known before the first sample.
struct RecordingHeader {
  DeviceSpecification device;
  std::string source;              ///< as the device was named: "scripted:wscg.toml"
  std::string started;             ///< wall clock before the first tick, ISO 8601 with ms, UTC ...
  double started_monotonic = 0.0;  ///< s: ... and at that moment the clock that samples are timed by
  double nominal_rate = 0.0;       ///< Hz
  Scheduling scheduling;
  double force_limit = 0.0;  ///< N; 0 = no force was given
  std::string felt_scene;    ///< the scene's resolved TOML text, with live sand; else empty
};

/// Where every tick went: elapsed = recorded + skipped + unread + dropped. Of a recording that was cut off it
/// is not known why ticks are missing: they are all counted as skipped.
struct TickCounts {
  std::int64_t elapsed = 0;   ///< ticks since the first, which is counted
  std::int64_t recorded = 0;  ///< are in the file
  std::int64_t skipped = 0;   ///< their time had passed when the loop woke, in a later one; never made up
  std::int64_t unread = 0;    ///< the device gave nothing, or no number
  std::int64_t dropped = 0;   ///< the ring was full: the disk did not keep up
  // Of the recorded ones, by flag:
  std::int64_t late = 0, clamped = 0, ramped = 0, rate_limited = 0, refused = 0, held = 0, interlocked = 0;
};

/// Of the elapsed ticks, those that were skipped.
double skipped_share(const TickCounts& ticks);

/// Counts a recorded sample's flags.
void count_flags(std::uint32_t flags, TickCounts& ticks);

/// How long after their time the loop came to ticks, those among them that it skipped for it; not-a-number of
/// a recording that was cut off.
struct Lateness {
  double mean = 0.0, p99 = 0.0, max = 0.0;  ///< s
};

/// Why a recording ended. Only the first four are what somebody asked for.
/// cut_off: nobody was left to say why (kill -9, a power failure).
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
  cut_off
};
/// "the time was up", ... for people and files.
const char* stop_reason_text(StopReason reason);
/// The reason of such a text; none where it is no reason's.
std::optional<StopReason> stop_reason_of(std::string_view text);
/// As asked for: the recording is complete.
bool is_complete(StopReason reason);

/// Known after the last sample.
struct RecordingFooter {
  TickCounts ticks;
  Lateness lateness;
  StopReason reason = StopReason::signal;
};
/// So many ticks were skipped, more than a tenth, that the samples may not tell what the hand did. Of a
/// recording that was cut off nobody knows.
bool is_starved(const RecordingFooter& footer);

/// A recording, read once from its beginning. Error: io.
class Recording {
 public:
  virtual ~Recording() = default;
  virtual const RecordingHeader& header() const = 0;
  /// The next samples, at most `most`; none at the end. Sequence and time increase.
  virtual std::vector<RecordedSample> next(std::size_t most) = 0;
  /// After the last sample: none, where it was cut off.
  virtual const std::optional<RecordingFooter>& footer() const = 0;
};

}  // namespace sandstroke
