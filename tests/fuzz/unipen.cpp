// Pen strokes in UNIPEN.
#include "import/unipen.h"

#include "samples.h"

using namespace sandstroke;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try_input([&] { require_sound(parse_unipen(as_text(data, size), "pen.unp")); });
  return 0;
}
