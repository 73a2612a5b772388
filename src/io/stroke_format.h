#pragma once

#include "core/output_file.h"
#include "haptics/stroke.h"
#include "hdf5/hdf5_file.h"
#include "hdf5/hdf5_grid_writer.h"

namespace sandstroke {

// What makes an HDF5 file a stroke: the group /stroke and its attributes.

inline constexpr const char* stroke_group = "/stroke";

// What this program writes of them. The mark is the root's: others' strokes have none there.
inline constexpr OutputKind stroke_output =
    hdf5_output("a stroke of a script or table", "sandstroke.converted_stroke", true);
inline constexpr OutputKind recording_output = hdf5_output("a recording", "sandstroke.recorded_stroke", true);

/// Error: input, unless the file is a stroke in the format of this program.
void check_stroke_format(const Hdf5Reader& file);

/// All that a stroke says beside its columns; the group is there. Error: io.
void write_stroke_attributes(Hdf5GridWriter& file, const Stroke& stroke);
/// Says of columns of /stroke, which are there, what they are, in which unit, and over which axes: as netCDF
/// has it, so that xarray opens them. The first is time.
void describe_stroke_columns(Hdf5GridWriter& file, const std::vector<std::string>& names);
/// What is not said stays as it is. Error: input.
void read_stroke_attributes(const Hdf5Reader& file, Stroke& stroke);

}  // namespace sandstroke
