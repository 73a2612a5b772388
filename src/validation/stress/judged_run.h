#pragma once

#include <array>
#include <optional>
#include <string>

#include "sim/solution.h"
#include "validation/stress/stress_report.h"

namespace sandstroke {

/// A run and what it came to.
struct JudgedRun {
  Verdict verdict = Verdict::broken;
  std::string reason;  ///< what is wrong with it, or the sentence of a refusal
  RunResult result;    ///< of a run that was not refused
  double overshoot =
      0.0;  ///< how far the end leaves the range of the starting heights, as a share of the highest
};

/// Runs a scene past the checks that a user's meets (check_scene, Simulation). In this order:
/// refused: one of them said so. broken: a height or figure is not a number; volume is lost, more than 1e-12
/// of what moved and than adding up the bed rounds off; without a stroke, and where the relaxation is
/// monotone (the isotropic law; rkl, which takes back what is not), a height left the range of the starting
/// ones. not_converged: not at rest in the end. stable: none of these.
JudgedRun judged_run(const Scene& scene, const HeightField& bed, const std::optional<Stroke>& stroke = {});

/// Many variations of one idea, told as one case: it is a surprise where any of them is.
class Variations {
 public:
  Variations(std::string group, std::string name, std::string settings, std::vector<Verdict> expected);
  /// variation: what tells it from the others, with units.
  void add(const JudgedRun& run, const std::string& variation);
  /// Where one surprised: its verdict, which it was and why. Otherwise the verdict that was met most, the
  /// count of variations and their worst figures.
  StressCase done() const;

 private:
  StressCase case_;
  std::array<int, 6> met_{};  // by verdict
  int surprises_ = 0;
  double overshoot_ = 0.0, drift_ = 0.0;
  std::int64_t passes_ = 0;
  std::string refusal_;
};

}  // namespace sandstroke
