#include "compare/image_difference.h"

#include <algorithm>
#include <cstdlib>

#include "core/error.h"

namespace sandstroke {

ImageDifference image_difference(const Image& golden, const Image& run) {
  if (golden.width != run.width || golden.height != run.height || golden.rgb.empty()) {
    throw_input_error(
        "pictures of {} x {} and {} x {} pixels cannot be compared; render both in the same size",
        golden.width, golden.height, run.width, run.height);
  }
  ImageDifference result;
  long differing = 0;
  for (int y = 0; y < golden.height; ++y) {
    for (int x = 0; x < golden.width; ++x) {
      const std::uint8_t *a = golden.pixel(x, y), *b = run.pixel(x, y);
      const int difference = std::max({std::abs(a[0] - b[0]), std::abs(a[1] - b[1]), std::abs(a[2] - b[2])});
      if (difference > 0) ++differing;
      if (difference > result.max) {
        result.max = difference;
        result.x = x;
        result.y = y;
      }
    }
  }
  result.fraction = static_cast<double>(differing) / (static_cast<double>(golden.width) * golden.height);
  return result;
}

}  // namespace sandstroke
