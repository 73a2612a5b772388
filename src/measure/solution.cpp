#include "measure/solution.h"

#include "measure/furrow.h"

namespace sandstroke {

Solution solve(const Scene& scene, const HeightField& start, const std::optional<Stroke>& stroke,
               Observers observers, const Checkpoints& checkpoints) {
  TipPathGatherer path(scene);
  observers.push_back(&path);
  Simulation simulation(scene, start, stroke);
  RunResult result = simulation.run(observers, checkpoints);
  result.furrow = path.furrow(start, simulation.bed());
  return {simulation.bed(), result};
}

}  // namespace sandstroke
