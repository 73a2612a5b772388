#pragma once

#include "picture/image.h"

namespace sandstroke {

/// How far two pictures of the same size are apart.
struct ImageDifference {
  int max = 0;            ///< of 255, largest difference of a channel
  int x = 0, y = 0;       ///< the first pixel with it
  double fraction = 0.0;  ///< 0 to 1, pixels that differ at all
};

/// Sizes must be equal and not empty (Error: input).
ImageDifference image_difference(const Image& golden, const Image& run);

}  // namespace sandstroke
