#pragma once

#include "core/progress.h"
#include "sim/simulation_observer.h"

namespace sandstroke {

/// A run's progress bar on the terminal, or lines in the log (Progress).
class RunProgress : public SimulationObserver {
 public:
  RunProgress() = default;
  explicit RunProgress(Progress::Clock::duration silence) : bar_("run", silence) {}
  void on_progress(double fraction) override {
    fraction_ = fraction;
    bar_.update(fraction);
  }
  void on_pass(std::int64_t passes, const BedNow&) override {
    constexpr std::int64_t long_while = 256;  // a tick may relax in two passes, or in a million
    const bool after_the_stroke = fraction_ == 0.0 || fraction_ == 1.0;
    if (after_the_stroke)
      bar_.count(passes, "relaxation passes");
    else if (passes % long_while == 0)
      bar_.update(fraction_);
  }

 private:
  Progress bar_{"run"};
  double fraction_ = 0.0;  // of the stroke
};

}  // namespace sandstroke
