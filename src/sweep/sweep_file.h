#pragma once

#include <filesystem>

#include "sweep/collected_sweep.h"

namespace sandstroke {

/// Writes a sweep as arrays over its axes, in the root group, with dimension scales, so that h5py and xarray
/// open it as a grid. With n_k the number of values of axis k, arrays of a grid have the shape (n_1, n_2,
/// ...), those of a Latin hypercube (points):
///   KEY of each axis   its values; scales of the grid, or arrays along the scale `point`
///   NAME of each metric, not-a-number where there is none; attributes units, long_name
///   point              the index
///   verdict            flag_values, flag_meanings as the CF conventions have them
///   reason             why points have no metrics, where some have none and say so
///   surface            (shape, ny, nx) m over scales y and x: virtual, read from points/, which go with the
///                      file; where all beds are the same
///   /timing/NAME       metrics that differ from run to run: all else is the same
/// Attributes of the root: format = "sandstroke.sweep", format_version, content_hash, version, commit, scene.
/// Error: io.
void write_sweep_file(const std::filesystem::path& path, const CollectedSweep& sweep,
                      const std::string& content_hash);

}  // namespace sandstroke
