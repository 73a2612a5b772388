#include <EGL/egl.h>
#include <EGL/eglext.h>

#include "core/error.h"
#include "render/offscreen_context.h"

namespace sandstroke {
namespace {

/// A context that EGL calls surfaceless: it has no display, no window and no window's configuration.
class EglContext : public OffscreenContext {
 public:
  EglContext() {
    setenv("LIBGL_ALWAYS_SOFTWARE", "1", 1);  // the same pictures, whatever graphics card is there
    display_ = eglGetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
    constexpr EGLint attributes[] = {EGL_CONTEXT_MAJOR_VERSION,
                                     3,
                                     EGL_CONTEXT_MINOR_VERSION,
                                     3,
                                     EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                     EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                     EGL_NONE};
    if (display_ != EGL_NO_DISPLAY && eglInitialize(display_, nullptr, nullptr) && eglBindAPI(EGL_OPENGL_API))
      context_ = eglCreateContext(display_, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes);
    if (context_ == EGL_NO_CONTEXT)
      throw_io_error(
          "no OpenGL 3.3 core context could be made (EGL error 0x{:04x}); install Mesa's EGL and llvmpipe "
          "(Debian: apt-get install libegl1 libegl-mesa0 libgl1-mesa-dri)",
          eglGetError());
  }
  ~EglContext() override {
    // A context that is current would live on.
    if (eglGetCurrentContext() == context_)
      eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    eglDestroyContext(display_, context_);
  }

  void make_current() override {
    if (!eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_))
      throw_io_error("the OpenGL context cannot be made current (EGL error 0x{:04x})", eglGetError());
  }

 private:
  EGLDisplay display_ = EGL_NO_DISPLAY;  // shared by the process; never given back
  EGLContext context_ = EGL_NO_CONTEXT;
};

}  // namespace

std::unique_ptr<OffscreenContext> make_offscreen_context() { return std::make_unique<EglContext>(); }

void load_offscreen_library() {}  // EGL is linked, and loads Mesa with the first context

void (*find_gl_function(const char* name))() { return eglGetProcAddress(name); }

}  // namespace sandstroke
