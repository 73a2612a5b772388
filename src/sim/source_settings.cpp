#include "sim/source_settings.h"

#include <cmath>

namespace sandstroke {

void describe_source(KeyVisitor& v, SourceSettings& source) {
  v.text("path", source.path,
         "a stroke that the nozzle follows from its start on, in metres on the bed (.toml, .h5 or a table of "
         "samples, relative to the scene); where its tool is lifted, the nozzle is closed; \"\": it stays");
  if (v.reads() && source.path.empty()) v.require("at");
  v.numbers("at", source.at.data(), 3, any_number, "m", "the nozzle's mouth; with a path: the path's shift");
  if (v.reads()) v.require("rate");
  v.number("rate", source.rate, any_number, "kg/s",
           "sand that it pours; negative: that it takes, of what stands above its mouth");
  v.number("radius", source.radius, not_negative, "m", "radius of the mouth; 0: a point");
  v.number("start", source.start, not_negative, "s", "time in the run at which it opens");
  double stop = std::isinf(source.stop) ? 0.0 : source.stop;
  v.number("stop", stop, not_negative, "s",
           "time in the run at which it closes; 0: at the end of its path, or else of the stroke");
  source.stop = stop > 0.0 ? stop : std::numeric_limits<double>::infinity();
}

}  // namespace sandstroke
