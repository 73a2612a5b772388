#include <GL/osmesa.h>
#include <dlfcn.h>

#include <array>

#include "core/error.h"
#include "core/machine.h"
#include "render/offscreen_context.h"

namespace sandstroke {
namespace {

constexpr const char* remedy = "allow more memory, or leave out pictures";

/// The library. It is loaded when the first context is made, because it brings a whole compiler.
class OsMesa {
 public:
  static const OsMesa& get() {
    static const OsMesa library;  // after a failure the next call tries again
    return library;
  }

  decltype(&OSMesaCreateContextAttribs) create_context;
  decltype(&OSMesaDestroyContext) destroy_context;
  decltype(&OSMesaMakeCurrent) make_current;
  decltype(&OSMesaGetProcAddress) find_function;

 private:
  OsMesa() {
    // Where the compiler finds no memory while it is loaded, it ends the program. Measured: 50 MB, and 190 MB
    // mapped.
    check_memory(60e6, "the library for drawing", remedy);
    check_addresses(210e6, "the library for drawing", remedy);
    library_ = dlopen("libOSMesa.so.8", RTLD_NOW | RTLD_LOCAL);
    if (!library_) throw_missing();
    find(create_context, "OSMesaCreateContextAttribs");
    find(destroy_context, "OSMesaDestroyContext");
    find(make_current, "OSMesaMakeCurrent");
    find(find_function, "OSMesaGetProcAddress");
  }
  template <class Function>
  void find(Function& function, const char* name) {
    function = reinterpret_cast<Function>(dlsym(library_, name));
    if (!function) throw_missing();
  }
  [[noreturn]] static void throw_missing() {
    throw_io_error(
        "pictures are drawn by the library OSMesa, which cannot be loaded ({}); install it (Debian: apt-get "
        "install libosmesa6), or leave out pictures",
        dlerror());
  }

  void* library_;  // never given back: threads of Mesa and the compiler may still run
};

class OsMesaContext : public OffscreenContext {
 public:
  OsMesaContext() {
    constexpr std::array<int, 13> attributes = {OSMESA_FORMAT,
                                                OSMESA_RGBA,
                                                OSMESA_DEPTH_BITS,
                                                0,
                                                OSMESA_PROFILE,
                                                OSMESA_CORE_PROFILE,
                                                OSMESA_CONTEXT_MAJOR_VERSION,
                                                3,
                                                OSMESA_CONTEXT_MINOR_VERSION,
                                                3,
                                                0,
                                                0,
                                                0};
    context_ = mesa_.create_context(attributes.data(), nullptr);
    if (!context_)
      throw_io_error("no OpenGL 3.3 core context could be made; install a Mesa with OSMesa and llvmpipe");
  }
  ~OsMesaContext() override { mesa_.destroy_context(context_); }

  void make_current() override {
    if (!mesa_.make_current(context_, unused_.data(), GL_UNSIGNED_BYTE, side, side))
      throw_io_error("the OpenGL context cannot be made current");
  }

 private:
  static constexpr int side = 16;
  const OsMesa& mesa_ = OsMesa::get();
  OSMesaContext context_;
  std::array<unsigned char, 4 * side * side> unused_{};  // OSMesa insists on a window to draw to
};

}  // namespace

std::unique_ptr<OffscreenContext> make_offscreen_context() { return std::make_unique<OsMesaContext>(); }

void load_offscreen_library() { OsMesa::get(); }

void (*find_gl_function(const char* name))() { return OsMesa::get().find_function(name); }

}  // namespace sandstroke
