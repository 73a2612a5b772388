#pragma once

#include <string>

#include "hdf5/hdf5_grid_writer.h"

namespace sandstroke {

/// Writes a bed's heights [m] as a dataset (rows, cols), chunk by chunk. The fill value is the level that
/// most of the bed has by its rule. Only sand at other heights takes room in the file and in memory. Any HDF5
/// reader sees the whole bed. A floor's -infinity, where there is none, becomes not-a-number. Error: io.
void write_bed(Hdf5Writer& file, const std::string& dataset, const HeightField& bed);

/// Writes GROUP/y and GROUP/x, the centres of a bed's rows and columns [m], as scales.
void write_bed_axes(Hdf5GridWriter& file, const std::string& group, const BedGeometry& bed);

}  // namespace sandstroke
