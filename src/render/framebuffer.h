#pragma once

#include "picture/image.h"
#include "render/gl_objects.h"
#include "render/pixel_rect.h"

namespace sandstroke {

/// The target of drawing: colour and depth with 4 samples a pixel. Error: input, where the size is out of
/// limits.
class Framebuffer {
 public:
  static constexpr int smallest = 16, largest = 8192;  ///< pixels a side

  Framebuffer(int width, int height);
  int width() const { return width_; }
  int height() const { return height_; }
  /// Makes it the target of drawing, and limits drawing to these pixels.
  void bind(const PixelRect& pixels) const;
  PixelRect whole() const { return {0, 0, width_, height_}; }
  /// Copies these pixels into a picture of this size. Each pixel is the mean of its samples.
  void read(const PixelRect& pixels, Image& image) const;

 private:
  int width_, height_;
  GlObject colour_, depth_, target_, resolved_colour_, resolved_;
};

}  // namespace sandstroke
