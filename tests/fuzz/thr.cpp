// A theta-rho track of a sand table.
#include "import/thr.h"

#include "samples.h"

using namespace sandstroke;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try_input([&] { require_path(parse_thr(as_text(data, size), "track.thr")); });
  return 0;
}
