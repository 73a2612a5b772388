// A scripted stroke.
#include "haptics/stroke_script.h"

#include <algorithm>

#include "fuzz.h"
#include "io/stroke_script_toml.h"
#include "play.h"

using namespace sandstroke;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try_input([&] {
    StrokeScript script = parse_stroke_script(as_text(data, size), "stroke.toml");
    presses_by_force(script);
    script.rate = std::min(script.rate, 20.0);  // many samples are no fault, but cost time
    const Stroke stroke = trace_script(script, ForceSettings{});
    if (stroke.size() < 100'000) play(stroke);
  });
  return 0;
}
