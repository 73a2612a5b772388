#include "cli/run_view.h"

#include <algorithm>
#include <chrono>
#include <limits>
#include <thread>

#include "core/interrupt.h"
#include "render/load_mesh.h"
#include "view/live_page.h"

namespace sandstroke {
namespace {

constexpr double late = 0.25, nearly_in_time = 0.05;  // s

void sleep(double seconds) { std::this_thread::sleep_for(std::chrono::duration<double>(seconds)); }

}  // namespace

RunView::RunView(Simulation& simulation, const std::string& title, bool opens)
    : simulation_(simulation),
      bed_(simulation.bed()),
      server_({bed_, shown_,
               ViewHello{title, simulation.bed(), height_range(simulation.bed()), simulation.scene().tool,
                         simulation.scene().device.max_force, std::nullopt, level_bottom(simulation.bed())},
               live_page(title)}),
      opener_(announce_view(server_, opens)),
      playing_(simulation.stroke_seconds() > 0.0) {
  wait_for_page(server_, "run");
}

void RunView::on_tick(const TickRecord& tick) {
  if (!clock_) clock_.emplace();
  const bool due = tick.time - published_ >= picture_interval;
  const double wait = tick.time - clock_->seconds();
  if (wait > 0.0) wait_until(tick.time);
  state_.lateness = std::max(-wait, 0.0);
  state_.max_lateness = std::max(state_.max_lateness, state_.lateness);
  ++ticks_;
  if (due || clock_->seconds() - published_at_ >= picture_interval) publish(tick);
}

/// Shows the time while it waits: a simulation reports no idle ticks, so the wait may be long.
void RunView::wait_until(double time) {
  for (double left; !interrupted() && (left = time - clock_->seconds()) > 0.0;) {
    sleep(std::min(left, picture_interval));
    if (left <= picture_interval) continue;
    state_.time = clock_->seconds();
    shown_.publish(state_);
  }
}

void RunView::publish(const TickRecord& tick) {
  const DeviceSettings& device = simulation_.scene().device;
  published_ = tick.time;
  published_at_ = clock_->seconds();
  state_.time = tick.time;
  state_.tip = tip_of(device, tick.device_position);
  state_.force = tick.device_force;
  state_.orientation = tick.hand.orientation;
  state_.depth = tick.contact ? tick.depth : std::numeric_limits<double>::quiet_NaN();
  state_.rate = rate_.at(published_at_, static_cast<double>(ticks_));
  state_.tip_known = tick.hand.down;
  show_load();
  shown_.publish(state_);
  if (state_.lateness > late) shown_.say("the run is slower than real time");
  if (state_.lateness < nearly_in_time) shown_.say("");
  bed_.publish(simulation_.shown_bed());
}

void RunView::show_load() {
  const std::optional<LoadSurface> load = simulation_.load_surface();
  if (!load) return state_.load.reset();
  TriangleMesh mesh = load_mesh(*load);
  if (!state_.load || state_.load->vertices != mesh.vertices)
    state_.load = std::make_shared<TriangleMesh>(std::move(mesh));
}

std::optional<double> RunView::lag() const {
  return state_.max_lateness > late ? std::optional(state_.max_lateness) : std::nullopt;
}

/// Shows the bed where no tick is told: as sources go on without a hand, in real time, and at the end, when
/// nothing waits for the clock.
void RunView::on_relaxation(const RelaxationRecord& relaxation) {
  if (playing_ && relaxation.time < simulation_.stroke_seconds()) return;
  if (playing_) {
    if (!clock_) clock_.emplace();
    wait_until(relaxation.time);
    state_.time = relaxation.time;
    state_.tip_known = false;
    shown_.publish(state_);
  }
  bed_.publish(simulation_.bed());
}

void RunView::on_pass(std::int64_t, const BedNow& bed_now) {
  if (playing_ || since_pass_.seconds() < picture_interval) return;
  since_pass_ = {};
  bed_.publish(bed_now());
}

}  // namespace sandstroke
