#pragma once

#include <vector>

#include "picture/image.h"
#include "sand/height_field.h"

namespace sandstroke {

/// A grid divided into square spots of side x side cells (those at its end may be smaller). A picture with
/// fewer pixels than cells can then still show a single cell.
struct Spots {
  Eigen::Index side = 1;            ///< cells
  Eigen::Index rows = 0, cols = 0;  ///< spots
  /// One cell per spot, row by row, as row * cols + col of the grid: the first cell that is not finite, or
  /// else the one furthest from zero.
  std::vector<Eigen::Index> cell;
};

/// At most `most` spots along the longer side. `values` is not empty.
Spots spots_of(const HeightGrid& values, int most);

/// The values at the spots' cells. The grid must have the shape that the spots were made from.
HeightGrid at_spots(const HeightGrid& values, const Spots& spots);

/// The largest |value| among those that are finite; 0 where none is.
double finite_magnitude(const HeightGrid& values);

/// run - golden of two pictures of one size. Each pixel shows its channel that differs most, from blue at
/// -span to red at span (of 255).
Image picture_difference_map(const Image& golden, const Image& run, int span);

}  // namespace sandstroke
