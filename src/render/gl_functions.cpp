#include "render/gl_functions.h"

#include <mutex>

#include "core/error.h"
#include "render/offscreen_context.h"

namespace sandstroke {
namespace {

template <class Function>
void load(Function& function, const char* name) {
  function = reinterpret_cast<Function>(find_gl_function(name));
  if (!function)
    throw_io_error("the OpenGL of this machine has no {}; install a Mesa with OpenGL 3.3 and llvmpipe", name);
}

}  // namespace

void load_gl_functions() {
  static std::once_flag once;
  std::call_once(once, [] {
#define SANDSTROKE_LOAD(name) load(name, #name);
    SANDSTROKE_GL_FUNCTIONS(SANDSTROKE_LOAD)
#undef SANDSTROKE_LOAD
  });
}

}  // namespace sandstroke
