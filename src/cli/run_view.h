#pragma once

#include <optional>

#include "cli/announce_view.h"
#include "cli/recent_rate.h"
#include "core/stopwatch.h"
#include "sim/simulation.h"
#include "view/view_server.h"

namespace sandstroke {

/// Shows a run in pages while it plays the stroke in real time (`run --view`). The run begins when the first
/// page is open. Ticks wait for the wall clock, which does not change the result's bits. The view reads the
/// simulation until the run is over.
class RunView : public SimulationObserver {
 public:
  /// Waits for a page, or an interrupt. Error: input, for a bed that is too large; io.
  RunView(Simulation& simulation, const std::string& title, bool opens);

  void on_tick(const TickRecord& tick) override;
  void on_relaxation(const RelaxationRecord&) override;
  void on_pass(std::int64_t, const BedNow& bed_now) override;
  void on_progress(double fraction) override { playing_ = fraction < 1.0; }

  /// The longest time [s] by which the run was behind real time, if over a quarter of a second.
  std::optional<double> lag() const;
  void end(const std::string& reason) { server_.end(reason); }

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

}  // namespace sandstroke
