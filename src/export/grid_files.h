#pragma once

#include <ostream>

#include "core/output_file.h"
#include "sand/height_field.h"

namespace sandstroke {

/// A format of heights that other programs read. Every number reads back to the same double. Neither format
/// has room for a mark.
struct GridFormat {
  OutputKind kind;
  double (*bytes)(double cells);  ///< about how large a file becomes
  /// Writes a whole file from heights [m], not-a-number where there are none, and a cell size [m]. False:
  /// interrupted().
  bool (*write)(std::ostream&, const HeightGrid&, double);
};

/// For numpy.load: float64 (rows, cols), as in a run file.
extern const GridFormat npy_format;
/// For programs of maps: the row of the largest y comes first, and the bed's centre is at 0, 0.
extern const GridFormat esri_grid_format;

}  // namespace sandstroke
