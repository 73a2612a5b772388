#include "sim/simulation.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/interrupt.h"
#include "core/stopwatch.h"
#include "haptics/recording.h"

namespace sandstroke {
namespace {

/// True once per period: at the last tick before each multiple of it; at most once a tick.
bool comes_due(std::int64_t tick, double servo_rate, double rate) {
  if (rate <= 0.0) return false;
  if (rate >= servo_rate) return true;  // also where rate x tick overflows
  const auto count = [&](std::int64_t t) {
    return std::floor(static_cast<double>(t) * rate / servo_rate + 1e-9);
  };
  return count(tick + 1) > count(tick);
}

}  // namespace

Simulation::Simulation(const Scene& scene, HeightField bed, std::optional<Stroke> stroke,
                       std::unique_ptr<Relaxer> relaxer)
    : scene_(scene),
      bed_(std::move(bed)),
      sand_(scene.tool, scene.displacement, scene.relaxation.travel * bed_.cell_size()),
      device_(scene.force, scene.device),
      relaxer_(relaxer ? std::move(relaxer) : make_relaxer(scene.relaxation, bed_.cell_size())) {
  if (!stroke) return;
  if (!(stroke->duration() * scene.device.servo_rate < 1e15))
    throw_input_error(
        "the stroke lasts {} s, more ticks at {} Hz than can be played; correct its times, or set "
        "stroke.stop",
        stroke->duration(), scene.device.servo_rate);
  check_inside(*stroke);
  stroke_.emplace(std::move(*stroke));
}

void Simulation::check_inside(const Stroke& stroke) const {
  const double highest = bed_.highest();
  const double half_x = 0.5 * bed_.cols() * bed_.cell_size(), half_y = 0.5 * bed_.rows() * bed_.cell_size();
  for (std::size_t i = 0; i < stroke.size(); ++i) {
    const Eigen::Vector3d tip = tip_of(scene_.device, stroke.position[i]);
    const bool outside = std::abs(tip.x()) > half_x || std::abs(tip.y()) > half_y;
    if (outside && stroke.pen_down(i) && tip.z() < highest)
      throw_input_error(
          "the stroke enters the sand outside the bed: at {:.3f} s it is at x = {:.4g} m, y = {:.4g} m, and "
          "the bed ends at {:.4g} and {:.4g} m; change stroke.scale, stroke.offset or bed.size",
          stroke.time[i], tip.x(), tip.y(), half_x, half_y);
  }
}

TickRecord Simulation::tick(double time, const Hand& hand, const Hand& next,
                            const std::function<void()>& slip) {
  TickRecord record;
  const SimulatedDevice::State reading = device_.device().read();
  const Eigen::Vector3d tip = tip_of(scene_.device, reading.position);
  const Eigen::Vector3d true_tip = tip_of(scene_.device, device_.device().state().position);
  record.time = time;
  record.hand = hand;
  record.next = next;
  record.device_position = reading.position;
  if (hand.down) {
    const Interaction interaction = sand_.move(bed_, tip, true_tip, slip);
    record.level = interaction.level;
    record.depth = interaction.depth;
    record.displaced_volume = interaction.displaced_volume;
    record.contact = interaction.contact;
  } else {
    sand_.lift();
    if (sand_.slip_is_due()) slip();
  }
  device_.feel(record);
  return record;
}

void Simulation::relax(double time) {
  sand_.hold(bed_);
  const RelaxationOutcome outcome = relaxer_->relax(
      bed_, [this](std::int64_t passes) { tell([&](auto& observer) { observer.on_pass(passes); }); });
  result_.relaxations += 1;
  result_.relaxation.add(outcome);
  tell([&](auto& observer) { observer.on_relaxation({time, outcome}); });
}

void Simulation::check_near(const TickRecord& record) const {
  const double hand = std::max(tip_of(scene_.device, record.hand.position).norm(),
                               tip_of(scene_.device, record.next.position).norm());
  const double far = 100.0 * (scene_.bed.width + scene_.bed.depth) + 2.0 * hand;
  const double distance = tip_of(scene_.device, device_.device().state().position).norm();
  if (!(distance < far))
    throw Error(
        ErrorKind::unstable,
        fmt::format(
            "at {:.4f} s the device has diverged ({:.3g} m from the bed's centre); lower force.k_s or "
            "force.k_f, or raise device.servo_rate or device.damping",
            record.time, distance));
}

void Simulation::run_stroke() {
  const double servo_rate = scene_.device.servo_rate;
  const double begin = stroke_->start_time();
  const double all_ticks = std::floor((stroke_->end_time() - begin) * servo_rate + 1e-9) + 1.0;
  if (!(all_ticks < static_cast<double>(most_ticks)))
    throw_input_error("{}: lasts {:.3g} s, {:.3g} ticks of device.servo_rate; cut it with stroke.stop",
                      scene_.stroke->file, stroke_->end_time() - begin, all_ticks);
  const auto ticks = static_cast<std::int64_t>(all_ticks);
  Hand hand = stroke_->at(begin);
  device_.start(hand);

  double time = 0.0;
  const std::function<void()> slip = [&] { relax(time); };
  const auto keep_frame = [&](double at) { tell([&](auto& observer) { observer.on_frame(at, bed_); }); };
  for (std::int64_t k = 0; k < ticks && !interrupted(); ++k) {
    time = static_cast<double>(k) / servo_rate;
    if (k == 0 && scene_.output.frames > 0.0) keep_frame(0.0);
    const double next_time = std::min(begin + static_cast<double>(k + 1) / servo_rate, stroke_->end_time());
    const Hand next = stroke_->at(next_time);
    const TickRecord record = tick(time, hand, next, slip);

    device_.advance(record);
    check_near(record);
    hand = next;
    if (stroke_->lifts_between(begin + time, next_time)) sand_.lift();

    result_.ticks += 1;
    result_.contact_ticks += record.contact;
    result_.displaced_volume += record.displaced_volume;
    if (record.contact) result_.max_depth = std::max(result_.max_depth, record.depth);
    tell([&](auto& observer) { observer.on_tick(record); });
    if (comes_due(k, servo_rate, scene_.relaxation.rate)) relax(time);
    if (comes_due(k, servo_rate, scene_.output.frames)) keep_frame(static_cast<double>(k + 1) / servo_rate);
    const double done = static_cast<double>(k + 1) / static_cast<double>(ticks);
    tell([&](auto& observer) { observer.on_progress(done); });
  }
  result_.simulated_seconds = static_cast<double>(result_.ticks) / servo_rate;
  result_.gaps = static_cast<int>(stroke_->gaps().size());
}

RunResult Simulation::run(const Observers& observers) {
  observers_ = observers;
  const Stopwatch watch;
  result_.volume_initial = bed_.volume();
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

bool returned_energy(const DeviceResult& result) {
  return result.least_absorbed_energy < -1e-3 * std::abs(result.absorbed_energy);
}

bool loop_returned_energy(const DeviceResult& result, const DeviceSettings& device) {
  const bool passive = result.least_passivity_margin > 0.0 && device.dropped_ticks == 0.0;
  return !passive && returned_energy(result);
}

}  // namespace sandstroke
