#pragma once

#include <memory>
#include <optional>
#include <string>

#include "sim/simulation.h"

namespace sandstroke {

/// Shows a run in pages while it plays the stroke in real time (`run --view`). Ticks wait for the wall clock,
/// which does not change the result's bits. The view reads the simulation until the run is over.
class RunView : public SimulationObserver {
 public:
  /// The longest time [s] by which the run was behind real time, if over a quarter of a second.
  virtual std::optional<double> lag() const = 0;
  /// Tells the pages why the run is over.
  virtual void end(const std::string& reason) = 0;
};

/// Waits until the first page is open, or for an interrupt. opens: starts the browser. Error: input, for a
/// bed that is too large, or if this program has no live view; io.
std::unique_ptr<RunView> open_run_view(Simulation& simulation, const std::string& title, bool opens);

}  // namespace sandstroke
