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
    // A tick may take two passes or a million; a look at the clock takes longer than a pass over few cells.
    constexpr std::int64_t passes_between_looks = 256;
    const bool after_the_stroke = fraction_ == 0.0 || fraction_ == 1.0;
    if (after_the_stroke)
      bar_.count(passes, "relaxation passes");
    else if (passes % passes_between_looks == 0)
      bar_.update(fraction_);
  }

 private:
  Progress bar_{"run"};
  double fraction_ = 0.0;  // of the stroke
};

}  // namespace sandstroke
