#pragma once

#include <string>
#include <vector>

#include "io/run_file.h"

namespace sandstroke {

/// A surface of a run, as --frame names it.
struct RunSurface {
  HeightGrid heights;
  double time = 0.0;      ///< s; the final one: infinity
  std::string ending;     ///< of a file's name without its format: "", "_initial", "_frame_0003"
  bool is_frame = false;  ///< one of those kept during the run
};

/// final, initial, or a frame's number. Error: input, which says that it can be one of `choices`, or what the
/// run lacks; io.
RunSurface surface_named(const RunFile& run, const std::string& name, const char* choices);

/// Of a run that holds frames (Error: input) [s].
std::vector<double> frame_times(const RunFile& run);

std::string frame_name(std::size_t k);

}  // namespace sandstroke
