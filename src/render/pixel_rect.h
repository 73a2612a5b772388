#pragma once

#include <algorithm>

namespace sandstroke {

/// Pixels of a picture, half-open; rows from the bottom, as OpenGL counts them.
struct PixelRect {
  int left = 0, bottom = 0, right = 0, top = 0;
  int width() const { return right - left; }
  int height() const { return top - bottom; }
  bool empty() const { return left >= right || bottom >= top; }
  bool touches(const PixelRect& other) const {
    return left < other.right && other.left < right && bottom < other.top && other.bottom < top;
  }
  /// Grows to hold the other rectangle, too.
  void extend(const PixelRect& other) {
    if (other.empty()) return;
    if (empty()) {
      *this = other;
      return;
    }
    left = std::min(left, other.left);
    right = std::max(right, other.right);
    bottom = std::min(bottom, other.bottom);
    top = std::max(top, other.top);
  }
};

}  // namespace sandstroke
