#include "validation/stress/stress.h"

#include "core/interrupt.h"

namespace sandstroke {

StressReport stress_all(const StressOptions& options) {
  struct Part {
    void (*run)(StressReport&, const StressOptions&);
    double end;  // fraction of the whole test that is done after it
  };
  constexpr Part parts[] = {{stress_device_loop, 0.4}, {stress_contact_loops, 0.42},
                            {stress_relaxation, 0.75}, {stress_grounds, 0.8},
                            {stress_sources, 0.82},    {stress_stone_strokes, 0.84},
                            {stress_any_ground, 0.9},  {stress_strokes, 1.0}};
  StressReport report;
  double begin = 0.0;
  for (const Part& part : parts) {
    if (interrupted()) break;
    const bool of_plugins = part.run == stress_relaxation || part.run == stress_strokes;
    if (!of_plugins && !options.plugin_laws.empty()) continue;
    StressOptions of_part = options;
    of_part.progress = [&](double fraction) { options.progress(begin + fraction * (part.end - begin)); };
    part.run(report, of_part);
    begin = part.end;
  }
  return report;
}

}  // namespace sandstroke
