#include "cli/run_view.h"

#include <algorithm>
#include <chrono>
#include <limits>
#include <thread>

#include "cli/announce_view.h"
#include "cli/recent_rate.h"
#include "core/interrupt.h"
#include "core/stopwatch.h"
#include "render/load_mesh.h"
#include "view/live_page.h"
#include "view/view_server.h"

namespace sandstroke {
namespace {

constexpr double late = 0.25, nearly_in_time = 0.05;  // s

void sleep(double seconds) { std::this_thread::sleep_for(std::chrono::duration<double>(seconds)); }

class LiveRunView : public RunView {
 public:
  LiveRunView(Simulation& simulation, const std::string& title, bool opens);

  void on_tick(const TickRecord& tick) override;
  void on_relaxation(const RelaxationRecord&) override;
  void on_pass(std::int64_t, const BedNow& bed_now) override;
  void on_progress(double fraction) override { playing_ = fraction < 1.0; }

  std::optional<double> lag() const override;
  void end(const std::string& reason) override { server_.end(reason); }

 private:
  void wait_until(double time);
  void publish(const TickRecord& tick);
  void show_load();

  Simulation& simulation_;
  LiveBed bed_;
  LiveState shown_;
  ViewServer server_;
  std::unique_ptr<ViewOpener> opener_;
  ViewState state_;
  RecentRate rate_;
  std::optional<Stopwatch> clock_;                 // from the first tick on
  double published_ = -1.0, published_at_ = -1.0;  // s, in the stroke and on the clock
  std::int64_t ticks_ = 0;
  bool playing_;  // the stroke goes on
  Stopwatch since_pass_;
};

LiveRunView::LiveRunView(Simulation& simulation, const std::string& title, bool opens)
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

void LiveRunView::on_tick(const TickRecord& tick) {
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
void LiveRunView::wait_until(double time) {
  for (double left; !interrupted() && (left = time - clock_->seconds()) > 0.0;) {
    sleep(std::min(left, picture_interval));
    if (left <= picture_interval) continue;
    state_.time = clock_->seconds();
    shown_.publish(state_);
  }
}

void LiveRunView::publish(const TickRecord& tick) {
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

void LiveRunView::show_load() {
  const std::optional<LoadSurface> load = simulation_.load_surface();
  if (!load) return state_.load.reset();
  TriangleMesh mesh = load_mesh(*load);
  if (!state_.load || state_.load->vertices != mesh.vertices)
    state_.load = std::make_shared<TriangleMesh>(std::move(mesh));
}

std::optional<double> LiveRunView::lag() const {
  return state_.max_lateness > late ? std::optional(state_.max_lateness) : std::nullopt;
}

/// Shows the bed where no tick is told: as sources go on without a hand, in real time, and at the end, when
/// nothing waits for the clock.
void LiveRunView::on_relaxation(const RelaxationRecord& relaxation) {
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

void LiveRunView::on_pass(std::int64_t, const BedNow& bed_now) {
  if (playing_ || since_pass_.seconds() < picture_interval) return;
  since_pass_ = {};
  bed_.publish(bed_now());
}

}  // namespace

std::unique_ptr<RunView> open_run_view(Simulation& simulation, const std::string& title, bool opens) {
  return std::make_unique<LiveRunView>(simulation, title, opens);
}

}  // namespace sandstroke
