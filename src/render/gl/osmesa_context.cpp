#include "render/offscreen_context.h"

#include <GL/osmesa.h>

#include <array>

#include "core/error.h"

namespace sandstroke {
namespace {

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
    context_ = OSMesaCreateContextAttribs(attributes.data(), nullptr);
    if (!context_)
      throw_io_error("no OpenGL 3.3 core context could be made; install a Mesa with OSMesa and llvmpipe");
  }
  ~OsMesaContext() override { OSMesaDestroyContext(context_); }

  void make_current() override {
    if (!OSMesaMakeCurrent(context_, unused_.data(), GL_UNSIGNED_BYTE, side, side))
      throw_io_error("the OpenGL context cannot be made current");
  }

 private:
  static constexpr int side = 16;
  OSMesaContext context_;
  std::array<unsigned char, 4 * side * side> unused_{};  // OSMesa insists on a window to draw to
};

}  // namespace

std::unique_ptr<OffscreenContext> make_offscreen_context() { return std::make_unique<OsMesaContext>(); }

}  // namespace sandstroke
