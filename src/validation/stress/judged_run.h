#pragma once

#include <array>
#include <optional>
#include <string>

#include "measure/solution.h"
#include "validation/stress/stress_report.h"

namespace sandstroke {

/// A run and its verdict.
struct JudgedRun {
  Verdict verdict = Verdict::broken;
  std::string reason;  ///< what is wrong with the run, or the error sentence of a refusal
  RunResult result;    ///< empty where the run was refused
  double overshoot =
      0.0;  ///< how far the end leaves the range of the starting heights, as a fraction of the highest
};

/// Checks a scene as for a user (check_scene, Simulation), runs it and judges it, in this order:
/// - refused: one of the checks threw an Error.
/// - broken: a height or figure is not a number; or more volume is lost than 1e-12 of the moved volume plus
///   the rounding of the bed's sum; or a height left the range of the starting ones. The range is checked
///   without a stroke only, and where relaxation is monotone (every law but `paper`; rkl, which takes back
///   steps that are not).
/// - not_converged: the sand is not at rest in the end.
/// - stable: none of these.
JudgedRun judged_run(const Scene& scene, const HeightField& bed, const std::optional<Stroke>& stroke = {},
                     Observers observers = {});

/// Reports many variations of one idea as one case. The case is a surprise if any variation is one.
class Variations {
 public:
  Variations(std::string group, std::string name, std::string settings, std::vector<Verdict> expected);
  /// variation: how it differs from the others, with units.
  void add(const JudgedRun& run, const std::string& variation);
  /// If a variation surprised: its verdict, which one it was and why. Otherwise the most frequent verdict,
  /// the count of variations and their worst figures.
  StressCase done() const;

 private:
  StressCase case_;
  std::array<int, 6> met_{};  // count of each verdict
  int surprises_ = 0;
  double overshoot_ = 0.0, drift_ = 0.0;
  std::int64_t passes_ = 0;
  std::string refusal_;
};

}  // namespace sandstroke
