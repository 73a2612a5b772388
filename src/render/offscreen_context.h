#pragma once

#include <memory>

namespace sandstroke {

/// An OpenGL 3.3 core context that needs no window and no display. It draws into framebuffer objects only, so
/// it has no size of its own. Made current before GL calls, per thread; another context may have been current
/// before.
class OffscreenContext {
 public:
  virtual ~OffscreenContext() = default;
  /// Error: io.
  virtual void make_current() = 0;
};

/// Software rendering (Mesa's OSMesa). Error: io, with what is missing.
std::unique_ptr<OffscreenContext> make_offscreen_context();

}  // namespace sandstroke
