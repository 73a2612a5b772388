#include "picture/shrunk.h"

#include <algorithm>
#include <cstdint>

namespace sandstroke {

Image shrunk(const Image& picture, int width) {
  if (picture.width <= width) return picture;
  // 64 bits: a picture's side may be 16384.
  const auto at = [](std::int64_t k, int pixels, int smaller) {
    return static_cast<int>(k * pixels / smaller);
  };
  const int height = std::max(1, at(picture.height, width, picture.width));
  Image small(width, height);
  for (int y = 0; y < height; ++y) {
    const int top = at(y, picture.height, height), bottom = at(y + 1, picture.height, height);
    for (int x = 0; x < width; ++x) {
      const int left = at(x, picture.width, width), right = at(x + 1, picture.width, width);
      std::int64_t sums[3] = {};
      for (int row = top; row < bottom; ++row)
        for (int col = left; col < right; ++col)
          for (int channel = 0; channel < 3; ++channel) sums[channel] += picture.pixel(col, row)[channel];
      const std::int64_t count = std::int64_t{bottom - top} * (right - left);
      for (int channel = 0; channel < 3; ++channel)
        small.pixel(x, y)[channel] = static_cast<std::uint8_t>((sums[channel] + count / 2) / count);
    }
  }
  return small;
}

}  // namespace sandstroke
