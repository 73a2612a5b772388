// A drawing in SVG.
#include "import/svg.h"

#include "samples.h"

using namespace sandstroke;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try_input([&] { require_path(parse_svg(as_text(data, size), "drawing.svg")); });
  return 0;
}
