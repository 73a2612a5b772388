#include "compare/image_difference.h"

#include <algorithm>
#include <cstdlib>

#include "core/error.h"

namespace sandstroke {
namespace {

/// The largest difference of a channel at a pixel.
int pixel_difference(const Image& golden, const Image& run, int x, int y) {
  const int alpha = golden.alpha_at(x, y), run_alpha = run.alpha_at(x, y);
  if (alpha == 0 && run_alpha == 0) return 0;
  const std::uint8_t *a = golden.pixel(x, y), *b = run.pixel(x, y);
  return std::max(
      {std::abs(a[0] - b[0]), std::abs(a[1] - b[1]), std::abs(a[2] - b[2]), std::abs(alpha - run_alpha)});
}

}  // namespace

ImageDifference image_difference(const Image& golden, const Image& run, double above) {
  if (golden.width != run.width || golden.height != run.height || golden.rgb.empty()) {
    throw_input_error(
        "pictures of {} x {} and {} x {} pixels cannot be compared; render both in the same size",
        golden.width, golden.height, run.width, run.height);
  }
  ImageDifference result;
  long differing = 0;
  for (int y = 0; y < golden.height; ++y) {
    for (int x = 0; x < golden.width; ++x) {
      const int difference = pixel_difference(golden, run, x, y);
      if (difference > above) ++differing;
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
