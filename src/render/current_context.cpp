#include "render/current_context.h"

#include <thread>

#include "core/machine.h"
#include "render/gl_functions.h"

namespace sandstroke {

CurrentContext::CurrentContext() {
  load_offscreen_library();  // first, because it leaves less room for the rest
  // Where Mesa or its compiler finds no memory, it ends the program. Measured: 90 MB, and threads' stacks.
  // Others who draw at the same time may not have taken theirs yet.
  check_memory(living_.count * (100e6 + 10e6 * std::thread::hardware_concurrency()), "drawing",
               "allow more memory, or leave out pictures");
  context_ = make_offscreen_context();
  context_->make_current();
  load_gl_functions();
}

}  // namespace sandstroke
