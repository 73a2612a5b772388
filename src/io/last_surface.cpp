#include "io/last_surface.h"

#include <spdlog/fmt/fmt.h>

namespace sandstroke {

LastSurface last_surface(const RunFile& run) {
  if (run.has_final()) return {run.final_bed(), "final surface"};
  LastSurface last{run.initial_bed(), "initial surface"};
  const std::vector<double> times = run.frame_times();
  for (std::size_t k = 0; k < times.size(); ++k) {
    run.apply_frame(static_cast<int>(k), last.surface);
    last.name = fmt::format("surface at {:.4g} s", times[k]);
  }
  return last;
}

}  // namespace sandstroke
