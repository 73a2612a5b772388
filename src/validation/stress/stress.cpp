#include "validation/stress/stress.h"

#include "core/interrupt.h"

namespace sandstroke {

StressReport stress_all(const StressOptions& options) {
  struct Part {
    void (*run)(StressReport&, const StressOptions&);
    double end;  // fraction of the whole test that is done after it
  };
  constexpr Part parts[] = {{stress_device_loop, 0.4}, {stress_relaxation, 0.8}, {stress_strokes, 1.0}};
  StressReport report;
  double begin = 0.0;
  for (const Part& part : parts) {
    if (interrupted()) break;
    if (part.run == stress_device_loop && !options.plugin_laws.empty()) continue;  // it uses no plugin laws
    StressOptions of_part = options;
    of_part.progress = [&](double fraction) { options.progress(begin + fraction * (part.end - begin)); };
    part.run(report, of_part);
    begin = part.end;
  }
  return report;
}

}  // namespace sandstroke
