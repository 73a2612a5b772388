// A plot in HPGL.
#include "import/hpgl.h"

#include "samples.h"

using namespace sandstroke;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try_input([&] { require_path(parse_hpgl(as_text(data, size), "plot.plt")); });
  return 0;
}
