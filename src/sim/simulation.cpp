#include "sim/simulation.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/elementary.h"
#include "core/error.h"
#include "core/interrupt.h"
#include "haptics/recorded_force.h"
#include "rules/force.h"
#include "rules/schedule.h"
#include "rules/talus.h"
#include "sim/check_inside.h"

namespace sandstroke {

Simulation::Simulation(const Scene& scene, HeightField bed, std::optional<Stroke> stroke,
                       std::unique_ptr<Relaxer> relaxer)
    : loop_(scene, std::move(bed), stroke.has_value(), std::move(relaxer)) {
  if (loop_.sources()) {
    if (stroke) loop_.sources()->stop_by(stroke->duration());
    const double last = loop_.sources()->last_stop();
    if (!(last * scene.device.servo_rate < 1e15))
      throw_input_error(
          "source.stop: the last source stops at {} s: a run cannot play that long; set an earlier stop",
          last);
    all_ticks_ = static_cast<std::int64_t>(std::ceil(last * scene.device.servo_rate)) + 1;
  }
  if (!stroke) return;
  if (!(stroke->duration() * scene.device.servo_rate < 1e15))
    throw_input_error(
        "the stroke lasts {} s: at {} Hz a run cannot play that many ticks; correct its times, or set "
        "stroke.stop",
        stroke->duration(), scene.device.servo_rate);
  check_inside(*stroke, loop_.scene(), loop_.bed());
  ticks_ = static_cast<std::int64_t>(std::floor(stroke->duration() * scene.device.servo_rate + 1e-9)) + 1;
  all_ticks_ = std::max(all_ticks_, ticks_);
  idle_ = idle_ticks(*stroke, scene.device);
  if (stroke->follows_sand) {
    follower_.emplace(scene.tool, scene.device);
    result_.followed.emplace();
  }
  stroke_.emplace(std::move(*stroke));
}

Hand Simulation::hand_at(double time) {
  const Hand hand = stroke_->at(time);
  return follower_ ? follower_->follow(hand, bed()) : hand;
}

/// Sand slides on a rough tool that accelerates in a direction steeper than the talus. Scripts change their
/// velocity at once, and a recorded hand's is noisy: what counts is the change over some time.
void Simulation::account_load(const TickRecord& record) {
  constexpr double over = 0.05;  // s
  const Eigen::Vector3d velocity = scene().device.scale * record.hand.velocity;
  if (record.carried == 0.0 || record.lifts || !record.hand.down) return slow_velocity_.reset();
  if (!slow_velocity_) slow_velocity_ = velocity;
  const Eigen::Vector3d acceleration = (velocity - *slow_velocity_) / over;
  *slow_velocity_ += acceleration / scene().device.servo_rate;
  const double holds = talus_slope(scene().relaxation.talus_angle) * (gravity + acceleration.z()),
               along = elementary::hypot(acceleration.x(), acceleration.y());
  const double slide = holds > 0.0 ? along / holds : std::numeric_limits<double>::infinity();
  if (slide <= result_.most_slide) return;
  result_.most_slide = slide;
  result_.slides_at = record.time;
}

void Simulation::account(const TickRecord& record) {
  result_.ticks += 1;
  result_.contact_ticks += record.contact;
  result_.displaced_volume += record.displaced_volume;
  if (record.contact) {
    result_.max_depth = std::max(result_.max_depth, record.depth);
    result_.max_contact_speed =
        std::max(result_.max_contact_speed, scene().device.scale * length_of(record.hand.velocity));
  }
  if (scene().tool.carries) account_load(record);
  if (!record.hand.down) return;
  if (std::isnan(record.level)) {
    const Eigen::Vector3d tip = tip_of(scene().device, record.device_position);
    result_.least_beside = std::min(result_.least_beside, bed().beyond_edge(tip.x(), tip.y()));
    return;
  }
  if (record.depth > result_.nearest) {
    result_.nearest = record.depth;
    result_.nearest_time = record.time;
  }
  if (record.asked_depth > 0.0)
    result_.followed->add(record.asked_depth, record.depth, repulse_force(record.asked_depth, scene().force),
                          record.repulse_force.z());
}

TickRecord Simulation::tick(double time, const Hand& hand, double next_time,
                            const std::function<void()>& relax) {
  const double asked_depth = follower_ && hand.down ? follower_->asked_depth() : TickRecord{}.asked_depth;
  TickRecord record = loop_.step(
      {time, hand, !stroke_->stroke().orientation.empty(), [&] { return hand_at(next_time); }, relax});
  record.asked_depth = asked_depth;
  return record;
}

TraceContent Simulation::trace_content() const {
  return {.recorded_force = stroke_ && !stroke_->stroke().force.empty(),
          .dropped_ticks = scene().device.dropped_ticks > 0.0,
          .asked_depth = follower_.has_value(),
          .torque = loop_.has_torque() || scene().tool.carries,
          .orientation = stroke_ && !stroke_->stroke().orientation.empty(),
          .floor = loop_.has_floor(),
          .carried = scene().tool.carries};
}

std::int64_t Simulation::told_ticks() const {
  std::int64_t told = ticks_;
  for (const TickRange& idle : idle_) told -= idle.end - idle.begin;
  return told;
}

double Simulation::seconds() const {
  const std::optional<SandSources>& sources = loop_.sources();
  return std::max(stroke_seconds(), sources ? sources->last_stop() : 0.0);
}

std::int64_t Simulation::idle(const TickRange& ticks) {
  if (loop_.sources()) {
    std::int64_t tick = ticks.begin;
    for (; tick < ticks.end && !interrupted(); ++tick) pour(tick);
    return tick;
  }
  const double servo_rate = scene().device.servo_rate, rate = scene().relaxation.rate;
  std::int64_t tick = ticks.begin, at_rest_from = ticks.end;
  for (; tick < ticks.end && !interrupted(); ++tick) {
    const std::int64_t due = at_rest_from < ticks.end ? ticks.end
                                                      : next_due({tick, ticks.end}, servo_rate, rate),
                       frame = next_due({tick, ticks.end}, servo_rate, scene().output.frames);
    tick = std::min(due, frame);
    if (tick == ticks.end) break;
    if (tick == due) {
      const RelaxationOutcome outcome = relax(static_cast<double>(tick) / servo_rate);
      if (outcome.converged && outcome.cells_visited == 0) at_rest_from = tick + 1;  // and all later ones
    }
    if (tick == frame) keep_frame(static_cast<double>(tick + 1) / servo_rate);
  }
  if (at_rest_from < tick)
    result_.relaxations += static_cast<std::int64_t>(times_due(tick, servo_rate, rate) -
                                                     times_due(at_rest_from, servo_rate, rate));
  result_.ticks += tick - ticks.begin;
  return tick;
}

void Simulation::pour(std::int64_t tick) {
  const double servo_rate = scene().device.servo_rate, time = static_cast<double>(tick) / servo_rate;
  loop_.pour(time);
  if (loop_.relaxation_comes_due(tick)) relax(time);
  if (comes_due(tick, servo_rate, scene().output.frames))
    keep_frame(static_cast<double>(tick + 1) / servo_rate);
  result_.ticks += 1;
}

RelaxationOutcome Simulation::relax(double time) {
  const RelaxationOutcome outcome = loop_.relax(time, [this](std::int64_t passes, const BedNow& bed_now) {
    tell([&](auto& observer) { observer.on_pass(passes, bed_now); });
  });
  result_.relaxations += 1;
  result_.relaxation.add(outcome);
  tell([&](auto& observer) { observer.on_relaxation({time, outcome}); });
  return outcome;
}

void Simulation::keep_frame(double time) {
  const HeightField& surface = shown_bed();
  if (const std::optional<LoadSurface> load = loop_.load_surface())
    tell([&](auto& observer) { observer.on_load(*load); });
  tell([&](auto& observer) { observer.on_frame(time, surface); });
}

void Simulation::visit_state(StateVisitor& state) {
  loop_.visit_state(state);
  state.value("next_tick", next_tick_);
  state.value("next_idle", next_idle_);
  state.value("hand", hand_);
  if (follower_) state.value("follower", *follower_);
  state.value("slow_velocity", slow_velocity_);
  double seconds = seconds_before_ + watch_.seconds();
  state.value("seconds", seconds);
  if (state.restores()) seconds_before_ = seconds;
  state.value("result", result_);
  for (SimulationObserver* observer : observers_) observer->visit_state(state);
}

void Simulation::begin(const std::string& state) {
  if (!state.empty()) {
    StateRestorer restorer(state);
    visit_state(restorer);
    return restorer.end();
  }
  if (stroke_) {
    hand_ = hand_at(stroke_->start_time());
    loop_.start(hand_);
  }
  if (scene().output.frames > 0.0) tell([&](auto& observer) { observer.on_frame(0.0, bed()); });
}

void Simulation::end_tick(const Checkpoints& checkpoints) {
  const double done = std::min(1.0, static_cast<double>(next_tick_) / static_cast<double>(all_ticks_));
  tell([&](auto& observer) { observer.on_progress(done); });
  if (!checkpoints.due || !checkpoints.due() || interrupted()) return;
  StateKeeper keeper;
  visit_state(keeper);
  checkpoints.keep(std::move(keeper).kept());
}

void Simulation::run_sources(const Checkpoints& checkpoints) {
  if (!interrupted()) loop_.lift();
  while (!loop_.sources()->ended() && !interrupted()) {
    pour(next_tick_++);
    end_tick(checkpoints);
  }
}

void Simulation::run_stroke(const Checkpoints& checkpoints) {
  const double servo_rate = scene().device.servo_rate;
  const double begin = stroke_->start_time();
  const auto time_of = [&](std::int64_t tick) {
    return std::min(begin + static_cast<double>(tick) / servo_rate, stroke_->end_time());
  };
  RecordedForce recorded(stroke_->stroke());
  double time = 0.0;
  const std::function<void()> relax_now = [&] { relax(time); };
  for (std::int64_t k = next_tick_; k < ticks_ && !interrupted(); ++k) {
    if (next_idle_ < std::ssize(idle_) && k == idle_[static_cast<std::size_t>(next_idle_)].begin) {
      k = idle(idle_[static_cast<std::size_t>(next_idle_++)]);
      if (interrupted()) break;
      if (follower_) follower_->restart();
      hand_ = hand_at(time_of(k));
      loop_.start(hand_);
    }
    time = static_cast<double>(k) / servo_rate;
    const double next_time = time_of(k + 1);
    TickRecord record = tick(time, hand_, next_time, relax_now);
    record.lifts = stroke_->lifts_between(begin + time, next_time);
    record.recorded_force = recorded.at(time);

    loop_.advance(record);
    hand_ = record.next;
    account(record);
    tell([&](auto& observer) { observer.on_tick(record); });
    if (loop_.relaxation_comes_due(k)) relax(time);
    if (comes_due(k, servo_rate, scene().output.frames)) keep_frame(static_cast<double>(k + 1) / servo_rate);
    next_tick_ = k + 1;
    end_tick(checkpoints);
  }
  result_.stroke = played_part(*stroke_);
}

RunResult Simulation::run(const Observers& observers, const Checkpoints& checkpoints) {
  observers_ = observers;
  watch_ = {};
  result_.volume_initial = bed().volume();
  if (stroke_ || loop_.sources()) begin(checkpoints.from);
  if (stroke_) run_stroke(checkpoints);
  if (loop_.sources()) run_sources(checkpoints);
  result_.simulated_seconds = static_cast<double>(result_.ticks) / scene().device.servo_rate;
  if (!interrupted()) {
    loop_.lift();
    relax(result_.simulated_seconds);
    constexpr int most_turns = 1000;  // sand that runs on from a bed to a tool and back does so ever less
    for (int turn = 0; turn < most_turns && loop_.end_spills() && !interrupted(); ++turn)
      relax(result_.simulated_seconds);
    result_.interrupted = interrupted() != 0 && !result_.relaxation.converged;
  } else {
    result_.interrupted = true;
  }
  result_.volume_final = bed().volume();
  result_.moved_volume = result_.relaxation.moved_volume + result_.displaced_volume;
  if (const std::optional<SandSources>& sources = loop_.sources()) {
    result_.sources = sources->ledgers();
    result_.given_volume = sources->given_volume();
    result_.moved_volume += sources->moved_volume();
  }
  if (const ToolLoad* const load = loop_.load()) {
    result_.load = load->ledger();
    result_.given_volume += load->given_volume();
  }
  if (!std::isfinite(result_.volume_final) || !std::isfinite(result_.moved_volume))
    throw Error(
        ErrorKind::unstable,
        "the sand's volume is too large for a number; lower the heights of bed.surface, or source.rate");
  if (result_.moved_volume > 0.0)
    result_.volume_drift =
        std::abs(result_.volume_final - result_.volume_initial - result_.given_volume) / result_.moved_volume;
  result_.device = loop_.device_result();
  result_.wall_seconds = seconds_before_ + watch_.seconds();
  return result_;
}

void FollowedSand::add(double asked, double reached, double force_asked, double force_reached) {
  ++ticks;
  const double fraction = 1.0 / static_cast<double>(ticks);
  const auto take_in = [fraction](double& mean, double value) { mean += fraction * (value - mean); };
  take_in(asked_depth, asked);
  take_in(depth, reached);
  take_in(asked_force, force_asked);
  take_in(force, force_reached);
}

bool returned_energy(const DeviceResult& result) {
  return result.least_absorbed_energy < -1e-3 * std::abs(result.absorbed_energy);
}

bool loop_returned_energy(const DeviceResult& result, const DeviceSettings& device) {
  const bool passive = result.least_passivity_margin > 0.0 && device.dropped_ticks == 0.0;
  return !passive && returned_energy(result);
}

}  // namespace sandstroke
