#include "compare/compare_runs.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <utility>

#include "compare/scene_difference.h"
#include "core/error.h"

namespace sandstroke {
namespace {

/// How many cells of the fine bed lie along a cell of the coarse one, over the same ground. It is 1 where
/// they do not fit or are equally large.
int cells_along(const RunFile& fine, const RunFile& coarse) {
  const int factor = fine.rows() / coarse.rows();
  const bool fits = factor > 1 && fine.rows() == factor * coarse.rows() &&
                    fine.cols() == factor * coarse.cols() &&
                    cell_size_check(coarse.cell_size(), factor * fine.cell_size()).passed;
  return fits ? factor : 1;
}

Check cells_check(const RunFile& golden, const RunFile& run, bool coarsen) {
  Check check = cell_size_check(golden.cell_size(), run.cell_size());
  if (check.passed) return check;
  constexpr bool in_means = true;
  const RunPair pair = run_pair(golden, run, in_means);
  const int factor = std::max(pair.golden.factor, pair.run.factor);
  const std::string means =
      fmt::format("means of {0} x {0} cells of {1}", factor, pair.run.factor > 1 ? "the run" : "golden");
  if (coarsen && factor > 1) {
    check = cell_size_check(pair.golden.cell_size(), pair.run.cell_size());
    check.sentence =
        fmt::format("coarsened to cells of {} m: {} are compared", pair.golden.cell_size(), means);
  } else if (factor > 1) {
    check.sentence += fmt::format("; --coarsen compares {}", means);
  } else if (coarsen) {
    check.sentence +=
        "; --coarsen has no effect: the beds differ in size, or the larger cell is no whole multiple of the "
        "smaller one";
  }
  return check;
}

}  // namespace

std::optional<std::vector<TickRecord>> whole_trace(const RunFile& run) {
  if (!run.has_trace()) return std::nullopt;
  return run.trace();
}

RunPair run_pair(const RunFile& golden, const RunFile& run, bool coarsen) {
  if (!coarsen) return {{golden}, {run}};
  return {{golden, cells_along(golden, run)}, {run, cells_along(run, golden)}};
}

Comparison compare_runs(const RunFile& golden, const RunFile& run, const Tolerances& tolerances,
                        bool coarsen) {
  Comparison comparison{run.name(), {}};
  std::vector<Check>& checks = comparison.checks;

  add_checks(checks, "golden complete", [&] { return std::vector{complete_check("golden", golden)}; });
  add_checks(checks, "run complete", [&] { return std::vector{complete_check("run", run)}; });
  add_checks(checks, "cell size", [&] { return std::vector{cells_check(golden, run, coarsen)}; });
  add_checks(checks, "floor", [&] { return floor_checks(golden, run, tolerances.height); });
  add_checks(checks, "initial height", [&] {
    const RunPair pair = run_pair(golden, run, coarsen);
    return std::vector{
        height_check("initial height", pair.golden.initial(), pair.run.initial(), tolerances.height)};
  });
  add_checks(checks, "final height", [&] {
    const RunPair pair = run_pair(golden, run, coarsen);
    return std::vector{
        height_check("final height", pair.golden.final(), pair.run.final(), tolerances.height)};
  });
  add_checks(checks, "frames", [&] { return std::vector{frames_check(golden, run)}; });
  add_checks(checks, "trace",
             [&] { return trace_checks(whole_trace(golden), whole_trace(run), tolerances); });
  comparison.settings =
      as_far_as_known([&] { return scene_difference(golden.scene_text(), run.scene_text()); });
  return comparison;
}

}  // namespace sandstroke
