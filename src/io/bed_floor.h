#pragma once

#include <string>

#include "hdf5/hdf5_grid_writer.h"
#include "hdf5/hdf5_reader.h"

namespace sandstroke {

/// The dataset of a run file that holds the floor under its sand [m], in the shape of the surfaces;
/// not-a-number where there is none. Runs without a floor do not have it.
inline constexpr const char* floor_dataset = "/surface/floor";

/// Writes it. Error: io.
void write_floor(Hdf5GridWriter& file, const HeightField& floor);

/// Reads the floor of a run file, for surfaces on this grid. Error: input, if it has another shape or
/// infinite heights.
HeightField read_floor(const Hdf5Reader& file, const BedGeometry& bed);

/// Error: input, naming the run file, if a surface is somewhere below a floor.
void check_above_floor(const HeightField& surface, const HeightField& floor, const std::string& run_name);

}  // namespace sandstroke
