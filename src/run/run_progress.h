#pragma once

#include "core/progress.h"
#include "sim/simulation_observer.h"

namespace sandstroke {

/// A run's progress bar on the terminal.
class RunProgress : public SimulationObserver {
 public:
  void on_progress(double fraction) override {
    fraction_ = fraction;
    bar_.update(fraction);
  }
  void on_pass(std::int64_t passes, const BedNow&) override {
    const bool after_the_stroke = fraction_ == 0.0 || fraction_ == 1.0;
    if (after_the_stroke) bar_.count(passes, "relaxation passes");
  }

 private:
  Progress bar_{"run"};
  double fraction_ = 0.0;  // of the stroke
};

}  // namespace sandstroke
