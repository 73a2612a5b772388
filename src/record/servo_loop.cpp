#include "record/servo_loop.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <limits>

namespace sandstroke {
namespace {

using Eigen::Vector3d;

constexpr auto relaxed = std::memory_order_relaxed;

/// The number of ticks in a time, to the nearest.
std::int64_t ticks_in(double seconds, double rate) {
  const double longest = 1e15;  // a later tick's time is not exact; that takes 30,000 years
  return std::llround(std::clamp(seconds * rate, 0.0, longest));
}

void copy(const Vector3d& from, double (&to)[3]) { Eigen::Map<Vector3d>{to} = from; }

ForceLimits limited(ForceLimits limits, double max_force) {
  limits.max_force = max_force;
  return limits;
}

}  // namespace

std::string hint_of(const ServoProgress& progress) {
  switch (progress.awaited) {
    case Awaited::nothing:
      return "";
    case Awaited::countdown:
      return fmt::format("begins in {:.1f} s", -progress.time);
    case Awaited::start_switch:
      return "press the start switch to begin";
    case Awaited::lift:
      return "lift the tool out of the sand to begin";
    case Awaited::contact:
      return "touch the sand to begin";
  }
  return "";
}

ServoLoop::ServoLoop(HapticDevice& device, FeltWorld* world, LoopClock& clock, SpscRing<RecordedSample>& ring,
                     const ServoSettings& settings)
    : device_(device),
      world_(world),
      clock_(clock),
      ring_(ring),
      settings_(settings),
      rate_(settings.rate),
      gives_force_(device.specification().max_force > 0.0),
      always_flagged_(device.specification().hand_feels ? 0u : std::uint32_t{unfelt_force}),
      force_limit_(world ? std::min(settings.force.max_force, device.specification().max_force) : 0.0),
      guard_(limited(settings.force, force_limit_), settings.rate),
      silent_{to_nanoseconds(settings.silence + device.longest_silence()), StopReason::device_lost, {}},
      wrong_{to_nanoseconds(settings.silence), StopReason::no_number, {}} {
  if (settings.stop_switch) stop_switch_.emplace(*settings.stop_switch, to_nanoseconds(settings.debounce));
}

RecordingFooter ServoLoop::run() noexcept {
  await_start();
  while (true) {
    if (ticks_.elapsed > last_tick_) stop(end_reason_);
    // This follows right after the last tick's command: where the watchdog has released the device meanwhile,
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
  for (std::atomic<double>& axis : seen_force_) axis.store(0.0, relaxed);
  heartbeat_.store(0, std::memory_order_release);
  return {ticks_, lateness_.summary(), static_cast<StopReason>(reason_.load())};
}

void ServoLoop::stop(StopReason reason) noexcept {
  int none = going_on;
  reason_.compare_exchange_strong(none, static_cast<int>(reason));
}

ServoProgress ServoLoop::progress() const noexcept {
  const auto vector = [](const std::array<std::atomic<double>, 3>& axes) {
    return Vector3d(axes[0].load(relaxed), axes[1].load(relaxed), axes[2].load(relaxed));
  };
  return {.time = to_seconds(time_.load(relaxed)),
          .elapsed = elapsed_.load(relaxed),
          .recorded = recorded_.load(relaxed),
          .force = force_.load(relaxed),
          .lateness = to_seconds(late_.load(relaxed)),
          .max_lateness = to_seconds(max_late_.load(relaxed)),
          .position = vector(seen_position_),
          .held = vector(seen_force_),
          .read = seen_read_.load(relaxed),
          .awaited = awaited_.load(relaxed)};
}

/// Computed from the tick's number, not from the tick before, so that no error adds up where a tick is no
/// whole number of nanoseconds.
std::int64_t ServoLoop::tick_time(std::int64_t tick) const noexcept {
  return start_ + std::llround(static_cast<double>(tick) * 1e9 / rate_);
}

std::int64_t ServoLoop::wait_for_tick() noexcept {
  if (ticks_.elapsed == 0) return start_;
  const std::int64_t due = tick_time(ticks_.elapsed), now = clock_.now();
  // Sleeping until a time that has passed gives the core away: on a busy machine, for many ticks.
  if (now >= due) return now;
  clock_.sleep_until(due);
  return clock_.now();
}

void ServoLoop::await_start() noexcept {
  awake_ = clock_.now();
  const StartSettings& asked = settings_.start;
  const std::int64_t countdown_end = awake_ + ticks_in(asked.countdown, 1e9);
  StartGate gate(asked, countdown_end, to_nanoseconds(settings_.debounce));
  DeviceReading before;
  std::optional<std::int64_t> read_before;
  played_from_ = awake_;
  if (asked.at_once()) return begin(awake_, nullptr);
  for (std::int64_t now = awake_; !stopped(); now = clock_.now()) {
    heartbeat_.store(now, std::memory_order_release);
    played_from_ = std::min(now, countdown_end);
    DeviceReading reading;
    const bool reads = read(now, reading);
    stop_where_it_lasts(!reads, silent_, now);
    if (reads) {
      const bool touches = world_ && world_->touches(reading);
      // Without displacing sand the force due is not known: infinity stands for any force.
      guard_.interlock().see(to_seconds(now - awake_),
                             touches ? std::numeric_limits<double>::infinity() : 0.0);
      const Awaited awaited = gate.see(now, reading.switches, touches);
      publish_waiting(now - countdown_end, awaited);
      if (awaited == Awaited::nothing) {
        if (asked.at_contact && read_before) return begin(*read_before, &before);
        return begin(now, nullptr);
      }
      before = reading;
      read_before = now;
    } else {
      guard_.interlock().close();
      read_before.reset();
    }
    if (const std::optional<double> stroke = device_.duration();
        stroke && now - played_from_ > ticks_in(*stroke, 1e9))
      stop(StopReason::stroke_end);
    clock_.sleep_until(now + to_nanoseconds(1.0 / rate_));
  }
}

void ServoLoop::begin(std::int64_t now, const DeviceReading* before) noexcept {
  start_ = now;
  if (settings_.duration) last_tick_ = ticks_in(*settings_.duration, rate_) - 1;
  if (const std::optional<double> stroke = device_.duration()) {
    const std::int64_t end = ticks_in(*stroke - to_seconds(start_ - played_from_), rate_);
    if (end < last_tick_) {
      last_tick_ = end;
      end_reason_ = StopReason::stroke_end;
    }
  }
  if (!before) return;
  world_->feel(0.0, *before);  // no force: there was no contact
  keep(*before, now, 0);
  lateness_.add(0);
  ++ticks_.elapsed;
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
  if (read(now, reading)) {
    FeltForce given = feel(now, reading);
    if (stopped()) given.force.setZero();  // a call may have hung, and its force is out of date
    answers = command(given.force);
    if (!answers) guard_.interlock().close();
    keep(reading, now, given.flags);
    if (stop_switch_ && stop_switch_->pressed(reading.switches, now)) stop(settings_.switch_reason);
  } else {
    ++ticks_.unread;
    guard_.interlock().close();
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

bool ServoLoop::read(std::int64_t now, DeviceReading& reading) noexcept {
  read_ = device_.read(to_seconds(now - played_from_), reading) && reading.position.allFinite() &&
          reading.velocity.allFinite() && reading.orientation.coeffs().allFinite();
  if (read_) position_ = reading.position;
  return read_;
}

FeltForce ServoLoop::feel(std::int64_t now, const DeviceReading& reading) noexcept {
  if (!world_) return {};
  const FeltForce wanted = world_->feel(to_seconds(now - start_), reading);
  FeltForce given = guard_.admit(to_seconds(now - awake_), wanted, held_);
  given.flags |= always_flagged_;
  stop_where_it_lasts((given.flags & refused_force) != 0, wrong_, now);
  return given;
}

/// False: the device refused a command and has taken none since. Refusing zero while it holds none does not
/// matter.
bool ServoLoop::command(const Vector3d& force) noexcept {
  if (gives_force_ && device_.command(force)) {
    held_ = force;
    refuses_ = false;
  } else if (!force.isZero(0.0) || !held_.isZero(0.0)) {
    refuses_ = true;
  }
  return !refuses_;
}

void ServoLoop::keep(const DeviceReading& reading, std::int64_t now, std::uint32_t flags) noexcept {
  RecordedSample sample;
  sample.sequence = static_cast<std::uint64_t>(ticks_.elapsed);
  sample.time = now;
  copy(reading.position, sample.position);
  copy(reading.velocity, sample.velocity);
  std::copy_n(reading.orientation.coeffs().data(), 4, sample.orientation);
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
  publish_hand();
  const bool withheld = force_limit_ > 0.0 && !guard_.interlock().is_open();
  awaited_.store(withheld ? Awaited::lift : Awaited::nothing, relaxed);
}

void ServoLoop::publish_hand() noexcept {
  for (int axis = 0; axis < 3; ++axis) {
    seen_position_[axis].store(position_[axis], relaxed);
    seen_force_[axis].store(held_[axis], relaxed);
  }
  seen_read_.store(read_, relaxed);
}

/// time [ns]: since the countdown's end.
void ServoLoop::publish_waiting(std::int64_t time, Awaited awaited) noexcept {
  time_.store(time, relaxed);
  publish_hand();
  awaited_.store(awaited, relaxed);
}

}  // namespace sandstroke
