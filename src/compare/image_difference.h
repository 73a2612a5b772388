#pragma once

#include "picture/image.h"

namespace sandstroke {

/// How far two pictures of the same size are apart. Alpha is a channel like the others; the colour of a pixel
/// that is fully transparent in both does not count.
struct ImageDifference {
  int max = 0;            ///< of 255, largest difference of a channel
  int x = 0, y = 0;       ///< the first pixel with it
  double fraction = 0.0;  ///< 0 to 1, pixels that differ by more than `above`
};

/// above: of 255. Sizes must be equal and not empty (Error: input).
ImageDifference image_difference(const Image& golden, const Image& run, double above = 0.0);

}  // namespace sandstroke
