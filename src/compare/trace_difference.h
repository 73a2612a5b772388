#pragma once

#include "io/run_file.h"

namespace sandstroke {

/// How far one column of two traces is apart, tick by tick.
struct ColumnDifference {
  double max = 0.0;  ///< largest |difference| (of a vector: its length); NaN where a value is not a number
  std::size_t tick = 0;  ///< where it is; the first that is not a number, if any. An index into the trace.
  double time = 0.0;     ///< s, of that tick in the golden trace
  double first = 0.0;    ///< s, of the first tick that differs at all
};

/// The largest values of a trace.
struct TracePeaks {
  double force = 0.0;  ///< N, on the device
  double depth = 0.0;  ///< m; 0 where the tip was never below the sand
};
TracePeaks trace_peaks(const std::vector<TickRecord>& trace);

/// The differences of two traces, over the ticks that both have.
struct TraceDifference {
  ColumnDifference time;   ///< s
  ColumnDifference force;  ///< N, on the device
  ColumnDifference depth;  ///< m
  ColumnDifference level;  ///< m
};

/// The level may be NaN in both where neither tool is in contact: the tool is lifted.
/// Only the fields named above and `contact` are compared.
TraceDifference trace_difference(const std::vector<TickRecord>& golden, const std::vector<TickRecord>& run);

}  // namespace sandstroke
