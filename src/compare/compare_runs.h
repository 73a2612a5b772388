#pragma once

#include <optional>

#include "compare/check.h"
#include "compare/run_checks.h"
#include "io/run_file.h"
#include "sand/cell_means.h"

namespace sandstroke {

/// Every tick of a run; none where it has no trace.
std::optional<std::vector<TickRecord>> whole_trace(const RunFile& run);

/// A run file as it is compared: over means of factor x factor cells.
struct ComparedRun {
  const RunFile& file;
  int factor = 1;

  double cell_size() const { return factor * file.cell_size(); }
  HeightField initial() const { return coarsened(file.initial_bed(), factor); }
  HeightField final() const { return coarsened(file.final_bed(), factor); }
};
struct RunPair {
  ComparedRun golden, run;
};
/// coarsen: of two beds over the same ground, one of which has cells that a whole number of the other's fill,
/// the finer one is seen over as large cells. Otherwise both as they are. Error: input, where they do not say
/// their cells.
RunPair run_pair(const RunFile& golden, const RunFile& run, bool coarsen);

/// Two run files: complete, the same bed (or, with coarsen, as run_pair() says), initial and final surface,
/// and the trace where there is one (in both, or in neither). The comparison has the run's name.
Comparison compare_runs(const RunFile& golden, const RunFile& run, const Tolerances& tolerances,
                        bool coarsen = false);

}  // namespace sandstroke
