#include "compare/compare_runs.h"

#include <utility>

namespace sandstroke {

std::optional<CountedTrace> whole_trace(const RunFile& run) {
  if (!run.has_trace()) return std::nullopt;
  std::vector<TickRecord> trace = run.trace();
  return CountedTrace{trace.size(), std::move(trace)};
}

Comparison compare_runs(const RunFile& golden, const RunFile& run, const Tolerances& tolerances) {
  Comparison comparison{run.name(), {}};
  std::vector<Check>& checks = comparison.checks;

  add_checks(checks, "golden complete", [&] { return std::vector{complete_check("golden", golden)}; });
  add_checks(checks, "run complete", [&] { return std::vector{complete_check("run", run)}; });
  add_checks(checks, "cell size",
             [&] { return std::vector{cell_size_check(golden.cell_size(), run.cell_size())}; });
  add_checks(checks, "initial height", [&] {
    return std::vector{
        height_check("initial height", golden.initial_bed(), run.initial_bed(), tolerances.height)};
  });
  add_checks(checks, "final height", [&] {
    return std::vector{height_check("final height", golden.final_bed(), run.final_bed(), tolerances.height)};
  });
  add_checks(checks, "frames", [&] { return std::vector{frames_check(golden, run)}; });
  add_checks(checks, "trace",
             [&] { return trace_checks(whole_trace(golden), whole_trace(run), tolerances); });
  return comparison;
}

}  // namespace sandstroke
