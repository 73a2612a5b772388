#pragma once

#include <string>

#include "io/run_file.h"

namespace sandstroke {

/// The latest surface that a run holds.
struct LastSurface {
  HeightField surface;
  std::string name;  ///< "final surface"; of a run that was cut off: "surface at 0.25 s", "initial surface"
};

/// Error: io, input, as RunFile.
LastSurface last_surface(const RunFile& run);

}  // namespace sandstroke
