#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace sandstroke {

/// A colour of an image: sRGB, 8 bits a channel.
using Rgb = std::array<std::uint8_t, 3>;

/// 8-bit RGB, rows from the top; pixel (x, y) starts at rgb[3 (y width + x)].
struct Image {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb;
  std::vector<std::uint8_t> alpha = {};  ///< one per pixel, 255: opaque; empty: all are opaque

  Image() = default;
  Image(int w, int h) : width(w), height(h), rgb(static_cast<std::size_t>(3) * w * h, 0) {}
  std::uint8_t* pixel(int x, int y) { return rgb.data() + 3 * (static_cast<std::size_t>(y) * width + x); }
  const std::uint8_t* pixel(int x, int y) const {
    return rgb.data() + 3 * (static_cast<std::size_t>(y) * width + x);
  }
  int alpha_at(int x, int y) const {
    return alpha.empty() ? 255 : alpha[static_cast<std::size_t>(y) * width + x];
  }
};

}  // namespace sandstroke
