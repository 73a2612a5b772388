#pragma once

#include <cstdlib>
#include <memory>

namespace sandstroke {

/// An OpenGL 3.3 core context that needs no window and no display. It draws into framebuffer objects only, so
/// it has no size of its own. Make it current before GL calls, in each thread; another context may have been
/// current before.
class OffscreenContext {
 public:
  virtual ~OffscreenContext() = default;
  OffscreenContext(const OffscreenContext&) = delete;
  OffscreenContext& operator=(const OffscreenContext&) = delete;
  /// Error: io.
  virtual void make_current() = 0;

 protected:
  OffscreenContext() {
    // Mesa reads these variables once per process. Its other drivers cannot draw multisampled targets
    // (softpipe) or crash without a window (zink).
    setenv("GALLIUM_DRIVER", "llvmpipe", 1);
    // With 512-bit vectors llvmpipe of Mesa 22 crashes on multisampled targets.
    setenv("LP_NATIVE_VECTOR_WIDTH", "256", 1);
  }
};

/// Loads the library that draws, unless it is there from the start. Error: io, with what is missing; input,
/// where memory is short.
void load_offscreen_library();

/// Software rendering by Mesa's llvmpipe, through OSMesa or EGL, as the build says (SANDSTROKE_GL). Error:
/// io, with what is missing.
std::unique_ptr<OffscreenContext> make_offscreen_context();

/// An OpenGL function, to be cast to its type; null where none has this name. Call it while there is a
/// context.
void (*find_gl_function(const char* name))();

}  // namespace sandstroke
