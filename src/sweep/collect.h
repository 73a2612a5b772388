#pragma once

#include "sweep/collected_sweep.h"

namespace sandstroke {

/// Checks, before any work is done, that collect() would replace only files of sweeps. Error: input, io.
void check_collectable(const SweepFolder& folder);

/// Writes sweep.h5 (write_sweep_file), sweep.csv and sweep.html into a sweep's folder, from the points that
/// it has. Error: io; input, as above.
CollectReport collect(const SweepFolder& folder);

}  // namespace sandstroke
