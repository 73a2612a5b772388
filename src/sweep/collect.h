#pragma once

#include "sweep/collected_sweep.h"

namespace sandstroke {

/// Refuses, before any work is done, files of others where collect() will write. Error: input, io.
void check_collectable(const SweepFolder& folder);

/// Writes sweep.h5 (write_sweep_file), sweep.csv and sweep.html into a sweep's folder, from the points that
/// are there. Error: io; input, as above.
CollectReport collect(const SweepFolder& folder);

}  // namespace sandstroke
