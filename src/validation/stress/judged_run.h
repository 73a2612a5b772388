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
  std::string bits;  ///< hash of the surface at the end, and of all forces on the way
};

/// Checks a scene as for a user (check_scene, Simulation), lays the bed on the scene's ground, runs it and
/// judges it, in this order:
/// - refused: one of the checks threw an Error.
/// - broken: a height, figure or force is not a number; or sand lies below the floor, if by a bit, in the end
///   or between passes; or more volume is lost than 1e-12 of the moved volume plus the rounding of the bed's
///   sum; or a height left the range of the starting ones. The range is checked without a stroke and sources
///   only, and where relaxation is monotone (every law but `paper`; rkl, which takes back steps that are
///   not).
/// - not_converged: the sand is not at rest in the end.
/// - stable: none of these.
JudgedRun judged_run(const Scene& scene, const HeightField& bed, const std::optional<Stroke>& stroke = {},
                     Observers observers = {});

/// The same on one thread, then on several: broken if a bit of heights or forces differs.
JudgedRun judged_on_threads(const Scene& scene, const HeightField& bed,
                            const std::optional<Stroke>& stroke = {});

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
