// Pen strokes in InkML.
#include "import/inkml.h"

#include "samples.h"

using namespace sandstroke;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try_input([&] { require_sound(parse_inkml(as_text(data, size), "pen.inkml")); });
  return 0;
}
