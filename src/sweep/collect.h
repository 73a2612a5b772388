#pragma once

#include "sweep/collected_sweep.h"

namespace sandstroke {

/// Writes sweep.h5 (write_sweep_file), sweep.csv and sweep.html into a sweep's folder, from the points that
/// are there. Error: io.
CollectReport collect(const SweepFolder& folder);

}  // namespace sandstroke
