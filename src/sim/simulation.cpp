#include "sim/simulation.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/interrupt.h"
#include "core/stopwatch.h"
#include "sim/own_laws.h"
#include "sim/recorded_force.h"
#include "sim/stroke_depth.h"
#include "tool/tool_surface.h"

namespace sandstroke {
namespace {

/// In how many of the ticks before this one it came due: once per period, at the last tick before each
/// multiple of it; at most once a tick.
double times_due(std::int64_t tick, double servo_rate, double rate) {
  if (rate <= 0.0) return 0.0;
  if (rate >= servo_rate) return static_cast<double>(tick);  // also where rate x tick overflows
  return std::floor(static_cast<double>(tick) * rate / servo_rate + 1e-9);
}

bool comes_due(std::int64_t tick, double servo_rate, double rate) {
  return times_due(tick + 1, servo_rate, rate) > times_due(tick, servo_rate, rate);
}

/// The first tick of a range in which it comes due; its end where there is none.
std::int64_t next_due(const TickRange& ticks, double servo_rate, double rate) {
  const double due = times_due(ticks.begin, servo_rate, rate);
  if (times_due(ticks.end, servo_rate, rate) == due) return ticks.end;
  // Bisection: due(low) == due < due(high).
  std::int64_t low = ticks.begin, high = ticks.end;
  while (high - low > 1) {
    const std::int64_t middle = low + (high - low) / 2;
    (times_due(middle, servo_rate, rate) == due ? low : high) = middle;
  }
  return low;
}

}  // namespace

Simulation::Simulation(const Scene& scene, HeightField bed, std::optional<Stroke> stroke,
                       std::unique_ptr<Relaxer> relaxer)
    : scene_(scene),
      bed_(std::move(bed)),
      own_rotation_(own_rotation(scene.tool)),
      sand_(scene.tool, scene.displacement, scene.relaxation.travel * bed_.cell_size(),
            stroke ? make_own_displacer(scene, bed_.cell_size()) : nullptr),
      device_(scene),
      relaxer_(relaxer ? std::move(relaxer) : make_relaxer(scene, bed_.cell_size())) {
  if (!stroke) return;
  contact_force_ = make_tool_force(scene, bed_.cell_size());
  if (!(stroke->duration() * scene.device.servo_rate < 1e15))
    throw_input_error(
        "the stroke lasts {} s, more ticks at {} Hz than can be played; correct its times, or set "
        "stroke.stop",
        stroke->duration(), scene.device.servo_rate);
  check_inside(*stroke);
  ticks_ = static_cast<std::int64_t>(std::floor(stroke->duration() * scene.device.servo_rate + 1e-9)) + 1;
  idle_ = idle_ticks(*stroke, scene.device);
  if (stroke->follows_sand) {
    follower_.emplace(scene.tool, scene.device);
    result_.followed.emplace();
  }
  stroke_.emplace(std::move(*stroke));
}

void Simulation::check_inside(const Stroke& stroke) const {
  const double highest = stroke.follows_sand ? 0.0 : bed_.highest();
  for (std::size_t i = 0; i < stroke.size(); ++i) {
    const Eigen::Vector3d tip = tip_of(scene_.device, stroke.position[i]);
    const double beyond = bed_.beyond_edge(tip.x(), tip.y());
    if (beyond > 0.0 && stroke.pen_down(i) && tip.z() < highest)
      throw_input_error(
          "the stroke enters the sand outside the bed: at {:.3f} s it is {:.4g} mm beyond its edge, at x = "
          "{:.4g} m, y = {:.4g} m; {}",
          stroke.time[i], 1e3 * beyond, tip.x(), tip.y(), way_onto_the_bed(stroke, scene_));
  }
}

Hand Simulation::hand_at(double time) {
  const Hand hand = stroke_->at(time);
  return follower_ ? follower_->follow(hand, bed_) : hand;
}

void Simulation::account(const TickRecord& record) {
  result_.ticks += 1;
  result_.contact_ticks += record.contact;
  result_.displaced_volume += record.displaced_volume;
  if (record.contact) {
    result_.max_depth = std::max(result_.max_depth, record.depth);
    result_.max_contact_speed =
        std::max(result_.max_contact_speed, scene_.device.scale * length_of(record.hand.velocity));
  }
  if (!record.hand.down) return;
  if (std::isnan(record.level)) {
    const Eigen::Vector3d tip = tip_of(scene_.device, record.device_position);
    result_.least_beside = std::min(result_.least_beside, bed_.beyond_edge(tip.x(), tip.y()));
    return;
  }
  if (record.depth > result_.nearest) result_.nearest = record.depth, result_.nearest_time = record.time;
  if (record.asked_depth > 0.0)
    result_.followed->add(record.asked_depth, record.depth, repulse_force(record.asked_depth, scene_.force),
                          record.repulse_force.z());
}

TickRecord Simulation::tick(double time, const Hand& hand, double next_time,
                            const std::function<void()>& slip) {
  TickRecord record;
  const SimulatedDevice::State reading = device_.device().read();
  const Eigen::Vector3d tip = tip_of(scene_.device, reading.position);
  const Eigen::Vector3d true_tip = tip_of(scene_.device, device_.device().state().position);
  if (follower_ && hand.down) record.asked_depth = follower_->asked_depth();
  record.time = time;
  record.hand = hand;
  record.device_position = reading.position;
  if (hand.down) {
    if (stroke_ && !stroke_->stroke().orientation.empty()) turn_tool(hand.orientation);
    const std::optional<Eigen::Vector3d> before = sand_.last_tip();
    const Interaction interaction = sand_.move(bed_, tip, true_tip, slip);
    const Eigen::Vector3d motion = before ? Eigen::Vector3d(true_tip - *before) : Eigen::Vector3d::Zero();
    if (contact_force_)
      record.wrench = contact_force_->in_tick(sand_, bed_, tip, motion, interaction.contact);
    record.level = interaction.level;
    record.depth = interaction.depth;
    record.displaced_volume = interaction.displaced_volume;
    record.contact = interaction.contact;
  } else {
    sand_.lift();
    if (contact_force_) contact_force_->lift();
    if (sand_.slip_is_due()) slip();
  }
  record.next = hand_at(next_time);
  device_.feel(record);
  return record;
}

void Simulation::turn_tool(const Eigen::Quaterniond& hand) {
  const Eigen::Matrix3d rotation = rotation_of(hand) * own_rotation_;
  sand_.turn(rotation);
  if (contact_force_) contact_force_->turn(rotation);
}

TraceContent Simulation::trace_content() const {
  return {.recorded_force = stroke_ && !stroke_->stroke().force.empty(),
          .dropped_ticks = scene_.device.dropped_ticks > 0.0,
          .asked_depth = follower_.has_value(),
          .torque = contact_force_ != nullptr,
          .orientation = stroke_ && !stroke_->stroke().orientation.empty()};
}

std::int64_t Simulation::told_ticks() const {
  std::int64_t told = ticks_;
  for (const TickRange& idle : idle_) told -= idle.end - idle.begin;
  return told;
}

std::int64_t Simulation::idle(const TickRange& ticks) {
  const double servo_rate = scene_.device.servo_rate, rate = scene_.relaxation.rate;
  std::int64_t tick = ticks.begin, at_rest_from = ticks.end;
  for (; tick < ticks.end && !interrupted(); ++tick) {
    const std::int64_t slip = at_rest_from < ticks.end ? ticks.end
                                                       : next_due({tick, ticks.end}, servo_rate, rate),
                       frame = next_due({tick, ticks.end}, servo_rate, scene_.output.frames);
    tick = std::min(slip, frame);
    if (tick == ticks.end) break;
    if (tick == slip) {
      const RelaxationOutcome outcome = relax(static_cast<double>(tick) / servo_rate);
      if (outcome.converged && outcome.cells_visited == 0) at_rest_from = tick + 1;  // and all that come
    }
    if (tick == frame) keep_frame(static_cast<double>(tick + 1) / servo_rate);
  }
  if (at_rest_from < tick)
    result_.relaxations += static_cast<std::int64_t>(times_due(tick, servo_rate, rate) -
                                                     times_due(at_rest_from, servo_rate, rate));
  result_.ticks += tick - ticks.begin;
  return tick;
}

void Simulation::check_own_law(const char* key, const std::string& name) const {
  if (!name.empty()) watch_->check(bed_, law_in_words(scene_.own, key, name));
}

RelaxationOutcome Simulation::relax(double time) {
  sand_.hold(bed_);
  check_own_law("displacement", scene_.own.displacement);
  const RelaxationOutcome outcome = relaxer_->relax(bed_, [this](std::int64_t passes, const BedNow& bed_now) {
    tell([&](auto& observer) { observer.on_pass(passes, bed_now); });
  });
  check_own_law("relaxation", scene_.own.relaxation);
  result_.relaxations += 1;
  result_.relaxation.add(outcome);
  tell([&](auto& observer) { observer.on_relaxation({time, outcome}); });
  return outcome;
}

void Simulation::keep_frame(double time) {
  tell([&](auto& observer) { observer.on_frame(time, bed_); });
}

void Simulation::check_near(const TickRecord& record) const {
  const double hand = std::max(tip_of(scene_.device, record.hand.position).norm(),
                               tip_of(scene_.device, record.next.position).norm());
  const double far = 100.0 * (scene_.bed.width + scene_.bed.depth) + 2.0 * hand;
  const double distance = tip_of(scene_.device, device_.device().state().position).norm();
  if (!(distance < far))
    throw Error(ErrorKind::unstable,
                fmt::format("at {:.4f} s the device has diverged ({:.3g} m from the bed's centre); {}",
                            record.time, distance, loop_remedies(scene_, device_.result().max_drag_force)));
}

void Simulation::run_stroke() {
  const double servo_rate = scene_.device.servo_rate;
  const double begin = stroke_->start_time();
  const auto time_of = [&](std::int64_t tick) {
    return std::min(begin + static_cast<double>(tick) / servo_rate, stroke_->end_time());
  };
  Hand hand = hand_at(begin);
  RecordedForce recorded(stroke_->stroke());
  device_.start(hand);

  double time = 0.0;
  const std::function<void()> slip = [&] { relax(time); };
  auto idle_next = idle_.begin();
  if (scene_.output.frames > 0.0) keep_frame(0.0);
  for (std::int64_t k = 0; k < ticks_ && !interrupted(); ++k) {
    if (idle_next != idle_.end() && k == idle_next->begin) {
      k = idle(*idle_next++);
      if (interrupted()) break;
      if (follower_) follower_->restart();
      hand = hand_at(time_of(k));
      device_.start(hand);
    }
    time = static_cast<double>(k) / servo_rate;
    const double next_time = time_of(k + 1);
    TickRecord record = tick(time, hand, next_time, slip);
    record.lifts = stroke_->lifts_between(begin + time, next_time);
    record.recorded_force = recorded.at(time);

    device_.advance(record);
    check_near(record);
    hand = record.next;
    if (record.lifts) {
      sand_.lift();
      if (contact_force_) contact_force_->lift();
    }

    account(record);
    tell([&](auto& observer) { observer.on_tick(record); });
    if (comes_due(k, servo_rate, scene_.relaxation.rate)) relax(time);
    if (comes_due(k, servo_rate, scene_.output.frames)) keep_frame(static_cast<double>(k + 1) / servo_rate);
    const double done = static_cast<double>(k + 1) / static_cast<double>(ticks_);
    tell([&](auto& observer) { observer.on_progress(done); });
  }
  result_.simulated_seconds = static_cast<double>(result_.ticks) / servo_rate;
  result_.stroke = played_part(*stroke_);
}

RunResult Simulation::run(const Observers& observers) {
  observers_ = observers;
  const Stopwatch watch;
  result_.volume_initial = bed_.volume();
  if (!scene_.own.relaxation.empty() || !scene_.own.displacement.empty()) watch_.emplace(bed_);
  if (stroke_) run_stroke();
  if (!interrupted()) {
    sand_.lift();
    relax(result_.simulated_seconds);
    result_.interrupted = interrupted() != 0 && !result_.relaxation.converged;
  } else {
    result_.interrupted = true;
  }
  result_.volume_final = bed_.volume();
  result_.moved_volume = result_.relaxation.moved_volume + result_.displaced_volume;
  if (!std::isfinite(result_.volume_final) || !std::isfinite(result_.moved_volume))
    throw Error(ErrorKind::unstable,
                "the sand's volume is too large for a number; lower the heights of bed.surface");
  if (result_.moved_volume > 0.0)
    result_.volume_drift = std::abs(result_.volume_final - result_.volume_initial) / result_.moved_volume;
  result_.device = device_.result();
  result_.wall_seconds = watch.seconds();
  return result_;
}

void FollowedSand::add(double asked, double reached, double force_asked, double force_reached) {
  const auto mean = [share = 1.0 / static_cast<double>(++ticks)](double& of, double value) {
    of += share * (value - of);
  };
  mean(asked_depth, asked), mean(depth, reached), mean(asked_force, force_asked), mean(force, force_reached);
}

bool returned_energy(const DeviceResult& result) {
  return result.least_absorbed_energy < -1e-3 * std::abs(result.absorbed_energy);
}

bool loop_returned_energy(const DeviceResult& result, const DeviceSettings& device) {
  const bool passive = result.least_passivity_margin > 0.0 && device.dropped_ticks == 0.0;
  return !passive && returned_energy(result);
}

}  // namespace sandstroke
