#pragma once

#include <vector>

#include "sim/simulation_observer.h"

namespace sandstroke {

/// Keeps all that a simulation tells.
struct Told : SimulationObserver {
  std::vector<TickRecord> ticks;
  std::vector<RelaxationRecord> relaxations;
  std::vector<double> frames;  // their times
  void on_tick(const TickRecord& tick) override { ticks.push_back(tick); }
  void on_relaxation(const RelaxationRecord& relaxation) override { relaxations.push_back(relaxation); }
  void on_frame(double time, const HeightField&) override { frames.push_back(time); }
};

}  // namespace sandstroke
