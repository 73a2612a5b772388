#pragma once

#include "sand/height_field.h"

namespace sandstroke {

/// True where a square grid equals itself, to the bit, under the 8 symmetries of the square.
inline bool has_square_symmetry(const HeightGrid& h) {
  const HeightGrid mirrored = h.rowwise().reverse();
  const HeightGrid upside_down = h.colwise().reverse();
  const HeightGrid transposed = h.transpose();
  return (h == mirrored).all() && (h == upside_down).all() &&
         (h == transposed).all();  // these generate the other 5
}

}  // namespace sandstroke
