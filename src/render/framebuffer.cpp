#include "render/framebuffer.h"

#include <algorithm>

#include "core/error.h"

namespace sandstroke {
namespace {

GlObject storage(GLenum format, int samples, int width, int height) {
  GlObject buffer = make_renderbuffer();
  glBindRenderbuffer(GL_RENDERBUFFER, buffer);
  glRenderbufferStorageMultisample(GL_RENDERBUFFER, samples, format, width, height);
  return buffer;
}

void check_complete(int width, int height) {
  check_gl("making a framebuffer");
  if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
    throw_io_error("this OpenGL cannot draw a picture of {} x {} pixels; choose a smaller one", width,
                   height);
}

}  // namespace

Framebuffer::Framebuffer(int width, int height) : width_(width), height_(height) {
  if (std::min(width, height) < smallest || std::max(width, height) > largest)
    throw_input_error("a picture of {} x {} pixels cannot be drawn; use sides from {} to {}", width, height,
                      smallest, largest);
  constexpr int samples = 4;
  colour_ = storage(GL_RGBA8, samples, width, height);
  depth_ = storage(GL_DEPTH_COMPONENT32F, samples, width, height);
  target_ = make_framebuffer();
  glBindFramebuffer(GL_FRAMEBUFFER, target_);
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, colour_);
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth_);
  check_complete(width, height);

  resolved_colour_ = storage(GL_RGBA8, 0, width, height);
  resolved_ = make_framebuffer();
  glBindFramebuffer(GL_FRAMEBUFFER, resolved_);
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, resolved_colour_);
  check_complete(width, height);
}

void Framebuffer::bind(const PixelRect& pixels) const {
  glBindFramebuffer(GL_FRAMEBUFFER, target_);
  glViewport(0, 0, width_, height_);
  glEnable(GL_SCISSOR_TEST);
  glScissor(pixels.left, pixels.bottom, pixels.width(), pixels.height());
}

void Framebuffer::read(const PixelRect& pixels, Image& image) const {
  const auto& [left, bottom, right, top] = pixels;
  glBindFramebuffer(GL_READ_FRAMEBUFFER, target_);
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, resolved_);
  glBlitFramebuffer(left, bottom, right, top, left, bottom, right, top, GL_COLOR_BUFFER_BIT, GL_NEAREST);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, resolved_);
  Image part(pixels.width(), pixels.height());
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(left, bottom, part.width, part.height, GL_RGB, GL_UNSIGNED_BYTE, part.rgb.data());
  check_gl("drawing a picture");
  for (int y = 0; y < part.height; ++y)  // GL counts rows from the bottom
    std::copy_n(part.pixel(0, y), 3 * part.width, image.pixel(left, height_ - 1 - bottom - y));
}

}  // namespace sandstroke
