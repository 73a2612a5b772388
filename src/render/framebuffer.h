#pragma once

#include "picture/image.h"
#include "render/gl_objects.h"

namespace sandstroke {

/// What is drawn to: colour and depth with 4 samples a pixel. Error: input, where the size is out of limits.
class Framebuffer {
 public:
  static constexpr int smallest = 16, largest = 8192;  ///< pixels a side

  Framebuffer(int width, int height);
  int width() const { return width_; }
  int height() const { return height_; }
  /// Makes it the target of drawing.
  void bind() const;
  /// The picture drawn, each pixel the mean of its samples.
  Image read() const;

 private:
  int width_, height_;
  GlObject colour_, depth_, target_, resolved_colour_, resolved_;
};

}  // namespace sandstroke
