#pragma once

#include <optional>

#include "compare/check.h"
#include "compare/run_checks.h"
#include "io/run_file.h"
#include "sand/cell_means.h"

namespace sandstroke {

/// Every tick of a run; none where it has no trace.
std::optional<std::vector<TickRecord>> whole_trace(const RunFile& run);

/// A run file as it is compared: each cell is the mean of factor x factor cells.
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
/// With coarsen, where the beds cover the same ground and a whole number of fine cells fills a coarse cell:
/// the finer bed is coarsened to the larger cells. Otherwise both stay as they are. Error: input, where a
/// file does not say its cells.
RunPair run_pair(const RunFile& golden, const RunFile& run, bool coarsen);

/// Compares two run files: complete, the same bed (with coarsen, see run_pair()) and floor, initial and final
/// surface, and the trace where there is one (in both, or in neither). The comparison has the run's name.
Comparison compare_runs(const RunFile& golden, const RunFile& run, const Tolerances& tolerances,
                        bool coarsen = false);

}  // namespace sandstroke
