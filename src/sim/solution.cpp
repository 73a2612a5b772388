#include "sim/solution.h"

#include "sim/furrow.h"

namespace sandstroke {

Solution solve(const Scene& scene, const HeightField& start, const std::optional<Stroke>& stroke,
               Observers observers) {
  TipPathGatherer path(scene);
  observers.push_back(&path);
  Simulation simulation(scene, start, stroke);
  RunResult result = simulation.run(observers);
  if (result.contact_ticks > 0)
    result.furrow = measure_furrow(start, simulation.bed(), path.path(), scene.tool.radius);
  return {simulation.bed(), result};
}

}  // namespace sandstroke
