#pragma once

#include <cstdlib>
#include <memory>

namespace sandstroke {

/// An OpenGL 3.3 core context that needs no window and no display. It draws into framebuffer objects only, so
/// it has no size of its own. Made current before GL calls, per thread; another context may have been current
/// before.
class OffscreenContext {
 public:
  virtual ~OffscreenContext() = default;
  OffscreenContext(const OffscreenContext&) = delete;
  OffscreenContext& operator=(const OffscreenContext&) = delete;
  /// Error: io.
  virtual void make_current() = 0;

 protected:
  OffscreenContext() {
    // With 512-bit vectors llvmpipe of Mesa 22 crashes on multisampled targets; it reads this once per
    // process.
    setenv("LP_NATIVE_VECTOR_WIDTH", "256", 1);
  }
};

/// Loads what draws, where that is not there from the start. Error: io, with what is missing; input, where
/// there is not the memory for it.
void load_offscreen_library();

/// Software rendering by Mesa's llvmpipe, through OSMesa or EGL: which of them, the build says
/// (SANDSTROKE_GL). Error: io, with what is missing.
std::unique_ptr<OffscreenContext> make_offscreen_context();

/// A function of OpenGL, to be cast to what it is; null where there is none of this name. To be asked when
/// there is a context.
void (*find_gl_function(const char* name))();

}  // namespace sandstroke
