// G-code of a sand table or a plotter: a line with the word that lifts its pen, and the program.
#include "import/gcode.h"

#include "samples.h"

using namespace sandstroke;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try_input([&] {
    std::string_view text = as_text(data, size);
    const std::string pen_up(take_line(text));
    require_path(parse_gcode(text, "path.gcode", pen_up));
  });
  return 0;
}
