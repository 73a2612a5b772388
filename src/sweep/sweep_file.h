#pragma once

#include <filesystem>

#include "sweep/collected_sweep.h"

namespace sandstroke {

/// Writes a sweep as arrays over its axes, in the root group, with dimension scales, so that h5py and xarray
/// open it as a grid. Arrays of a grid have the shape (n_1, n_2, ...), with n_k the number of values of axis
/// k. Those of a Latin hypercube have the shape (points):
///   KEY of each axis   its values; scales of the grid, or arrays along the scale `point`
///   NAME of each metric, NaN if there is none; attributes units, long_name
///   point              the index
///   verdict            flag_values, flag_meanings of the CF conventions
///   reason             why points have no metrics; only if some have a reason
///   surface            (shape, ny, nx) m over scales y and x, if all beds are the same. Virtual: points/
///                      holds the heights, and must go with the file
///   /timing/NAME       the only metrics that differ from run to run
/// Attributes of the root: format = "sandstroke.sweep", format_version, content_hash, version, commit, scene.
/// Error: io.
void write_sweep_file(const std::filesystem::path& path, const CollectedSweep& sweep,
                      const std::string& content_hash);

}  // namespace sandstroke
