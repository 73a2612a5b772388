#pragma once

#include <optional>
#include <string>
#include <vector>

#include "io/run_file.h"

namespace sandstroke {

/// A surface of a run that --frame names.
struct RunSurface {
  HeightField surface;
  double time = 0.0;      ///< s; the final one: infinity
  std::string ending;     ///< for file names, before the extension: "", "_initial", "_frame_0003"
  bool is_frame = false;  ///< it was kept during the run
  std::optional<LoadSurface> load = {};  ///< the sand on the tool then
};

/// Reads a surface by name: final, initial, or a frame's number. Error: input, which lists `choices`, or says
/// what the run lacks; io.
RunSurface surface_named(const RunFile& run, const std::string& name, const char* choices);

/// The times of a run's frames [s]. Error: input, if it has none.
std::vector<double> frame_times(const RunFile& run);

std::string frame_name(std::size_t k);

}  // namespace sandstroke
