#include "record/servo_loop.h"

#include <algorithm>
#include <limits>

namespace sandstroke {
namespace {

using Eigen::Vector3d;

constexpr auto relaxed = std::memory_order_relaxed;

/// How many ticks make up a time, to the nearest.
std::int64_t ticks_in(double seconds, double rate) {
  const double longest = 1e15;  // beyond it a tick's time is no longer exact, after 30,000 years
  return std::llround(std::clamp(seconds * rate, 0.0, longest));
}

void copy(const Vector3d& from, double (&to)[3]) { Eigen::Map<Vector3d>{to} = from; }

ForceLimits limited(ForceLimits limits, double max_force) {
  limits.max_force = max_force;
  return limits;
}

}  // namespace

ServoLoop::ServoLoop(HapticDevice& device, FeltWorld* world, LoopClock& clock, SpscRing<RecordedSample>& ring,
                     const ServoSettings& settings)
    : device_(device),
      world_(world),
      clock_(clock),
      ring_(ring),
      rate_(settings.rate),
      last_tick_(std::numeric_limits<std::int64_t>::max()),
      end_reason_(StopReason::duration),
      gives_force_(device.specification().max_force > 0.0),
      force_limit_(world ? std::min(settings.force.max_force, device.specification().max_force) : 0.0),
      guard_(limited(settings.force, force_limit_), settings.rate),
      silent_{to_nanoseconds(settings.silence + device.longest_silence()), StopReason::device_lost, {}},
      wrong_{to_nanoseconds(settings.silence), StopReason::no_number, {}} {
  if (settings.duration) last_tick_ = ticks_in(*settings.duration, rate_) - 1;
  if (const std::optional<double> stroke = device.duration();
      stroke && ticks_in(*stroke, rate_) < last_tick_) {
    last_tick_ = ticks_in(*stroke, rate_);
    end_reason_ = StopReason::stroke_end;
  }
  if (settings.stop_switch) stop_switch_.emplace(*settings.stop_switch, to_nanoseconds(settings.debounce));
}

RecordingFooter ServoLoop::run() noexcept {
  start_ = clock_.now();
  while (true) {
    if (ticks_.elapsed > last_tick_) stop(end_reason_);
    // Right after the last tick's command: where the watchdog has released the device since the tick looked,
    // that command is taken back at once.
    if (stopped()) break;
    const std::int64_t now = wait_for_tick();
    heartbeat_.store(now, std::memory_order_release);
    skip_ticks_before(now);
    if (ticks_.elapsed <= last_tick_) {
      lateness_.add(now - tick_time(ticks_.elapsed));
      serve_tick(now);
      ++ticks_.elapsed;
    }
    publish(now);
  }
  if (!device_.command(Vector3d::Zero())) device_.release();
  force_.store(0.0, relaxed);
  heartbeat_.store(0, std::memory_order_release);
  return {ticks_, lateness_.summary(), static_cast<StopReason>(reason_.load())};
}

void ServoLoop::stop(StopReason reason) noexcept {
  int none = going_on;
  reason_.compare_exchange_strong(none, static_cast<int>(reason));
}

ServoProgress ServoLoop::progress() const noexcept {
  return {to_seconds(time_.load(relaxed)), elapsed_.load(relaxed),
          recorded_.load(relaxed),         force_.load(relaxed),
          to_seconds(late_.load(relaxed)), to_seconds(max_late_.load(relaxed))};
}

/// From the tick's number, not from the tick before: nothing adds up where a tick is no whole number of
/// nanoseconds.
std::int64_t ServoLoop::tick_time(std::int64_t tick) const noexcept {
  return start_ + std::llround(static_cast<double>(tick) * 1e9 / rate_);
}

std::int64_t ServoLoop::wait_for_tick() noexcept {
  if (ticks_.elapsed == 0) return start_;
  const std::int64_t due = tick_time(ticks_.elapsed), now = clock_.now();
  // To sleep until a time that has passed is to give the core away: on a busy machine, for many ticks.
  if (now >= due) return now;
  clock_.sleep_until(due);
  return clock_.now();
}

void ServoLoop::skip_ticks_before(std::int64_t now) noexcept {
  while (ticks_.elapsed <= last_tick_ && now >= tick_time(ticks_.elapsed + 1)) {
    lateness_.add(now - tick_time(ticks_.elapsed));
    ++ticks_.skipped;
    ++ticks_.elapsed;
  }
}

void ServoLoop::serve_tick(std::int64_t now) noexcept {
  DeviceReading reading;
  bool answers = false;
  if (read(to_seconds(now - start_), reading)) {
    FeltForce given = feel(now, reading);
    if (stopped()) given.force.setZero();  // perhaps for a call that hung: its force is of another time
    answers = command(given.force);
    keep(reading, now, given.flags);
    if (stop_switch_ && stop_switch_->pressed(reading.switches, now)) stop(StopReason::stop_switch);
  } else {
    ++ticks_.unread;
    command(Vector3d::Zero());
  }
  stop_where_it_lasts(!answers, silent_, now);
}

void ServoLoop::stop_where_it_lasts(bool fails, Fault& fault, std::int64_t now) noexcept {
  if (!fails) {
    fault.since.reset();
    return;
  }
  if (!fault.since) fault.since = now;
  if (now - *fault.since >= fault.limit) stop(fault.reason);
}

bool ServoLoop::read(double time, DeviceReading& reading) noexcept {
  return device_.read(time, reading) && reading.position.allFinite() && reading.velocity.allFinite();
}

FeltForce ServoLoop::feel(std::int64_t now, const DeviceReading& reading) noexcept {
  if (!world_) return {};
  const double time = to_seconds(now - start_);
  const FeltForce given = guard_.admit(time, world_->feel(time, reading), held_);
  stop_where_it_lasts((given.flags & refused_force) != 0, wrong_, now);
  return given;
}

/// True: the device holds it.
bool ServoLoop::command(const Vector3d& force) noexcept {
  if (gives_force_ && device_.command(force)) held_ = force;
  return held_ == force;
}

void ServoLoop::keep(const DeviceReading& reading, std::int64_t now, std::uint32_t flags) noexcept {
  RecordedSample sample;
  sample.sequence = static_cast<std::uint64_t>(ticks_.elapsed);
  sample.time = now;
  copy(reading.position, sample.position);
  copy(reading.velocity, sample.velocity);
  copy(held_, sample.force);
  sample.switches = reading.switches;
  const std::int64_t due = tick_time(ticks_.elapsed);
  if (2 * (now - due) > tick_time(ticks_.elapsed + 1) - due) flags |= late_sample;
  if (sample.sequence != expected_) flags |= after_skipped_ticks;
  sample.flags = flags;
  if (!ring_.push(sample)) {
    ++ticks_.dropped;
    return;
  }
  expected_ = sample.sequence + 1;
  ++ticks_.recorded;
  count_flags(flags, ticks_);
}

void ServoLoop::publish(std::int64_t now) noexcept {
  time_.store(now - start_, relaxed);
  late_.store(now - tick_time(ticks_.elapsed - 1), relaxed);
  max_late_.store(lateness_.max(), relaxed);
  elapsed_.store(ticks_.elapsed, relaxed);
  recorded_.store(ticks_.recorded, relaxed);
  force_.store(held_.norm(), relaxed);
}

}  // namespace sandstroke
