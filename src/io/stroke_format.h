#pragma once

#include "core/output_file.h"
#include "haptics/stroke.h"
#include "hdf5/hdf5_file.h"
#include "hdf5/hdf5_grid_writer.h"

namespace sandstroke {

// The group /stroke and its attributes make an HDF5 file a stroke.

inline constexpr const char* stroke_group = "/stroke";

// The strokes that this program writes. The mark is in the root; strokes of other programs have none there.
inline constexpr OutputKind stroke_output =
    irreplaceable(hdf5_output("a stroke of a script or table", "sandstroke.converted_stroke"));
inline constexpr OutputKind recording_output =
    irreplaceable(hdf5_output("a recording", "sandstroke.recorded_stroke"));

/// Error: input, unless the file is a stroke in the format of this program.
void check_stroke_format(const Hdf5Reader& file);

/// Writes all that a stroke has besides its columns; the group must exist. Error: io.
void write_stroke_attributes(Hdf5GridWriter& file, const Stroke& stroke);
/// Gives columns of /stroke, which must exist, their meaning, unit and axes as netCDF has them, so that
/// xarray opens them. The first is time.
void describe_stroke_columns(Hdf5GridWriter& file, const std::vector<std::string>& names);
/// Reads the attributes; the columns must be there. What is missing stays as it is, or is usual. Error:
/// input.
void read_stroke_attributes(const Hdf5Reader& file, Stroke& stroke);

}  // namespace sandstroke
