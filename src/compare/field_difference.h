#pragma once

#include "sand/height_field.h"

namespace sandstroke {

/// How far two surfaces of the same bed are apart (run - golden).
struct FieldDifference {
  double max = 0.0;      ///< m, largest |difference|; NaN where either surface has a cell that is not finite
  int row = 0, col = 0;  ///< where it is (the first such cell); the first cell that is not finite, if any
  double x = 0.0, y = 0.0;  ///< m, that cell's centre
  std::int64_t cells = 0;   ///< how many differ
  double rms = 0.0;         ///< m, over all cells
  double volume = 0.0;      ///< m^3
};

/// Shapes must be equal and not empty (Error: input). A tile that neither surface has costs nothing where
/// both are level there.
FieldDifference field_difference(const HeightField& golden, const HeightField& run);
FieldDifference field_difference(const HeightGrid& golden, const HeightGrid& run, double cell_size);

/// The smallest rectangle that holds every cell which differs by more than limit [m] or is not finite; empty
/// where there is none. Shapes and cost: as above.
CellRange differing_cells(const HeightField& golden, const HeightField& run, double limit);

}  // namespace sandstroke
