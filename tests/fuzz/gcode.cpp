// G-code of a sand table or a plotter.
#include "import/gcode.h"

#include "samples.h"

using namespace sandstroke;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try_input([&] { require_sound(parse_gcode(as_text(data, size), "path.gcode")); });
  return 0;
}
