#pragma once

#include "sand/height_field.h"

namespace sandstroke {

/// Sand that relaxes around a stroke moves by no more than this fraction of the largest change.
inline constexpr double settled_fraction = 0.02;

/// The smallest rectangle that holds every cell whose height differs by more than threshold [m]; empty where
/// there is none. Error: input, where the grids differ in shape.
CellRange changed_cells(const HeightGrid& initial, const HeightGrid& final, double threshold);

}  // namespace sandstroke
