#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "measure/solution.h"

namespace sandstroke {

/// The second solution that a run is compared with. finer: every step half as large, which takes 10 to 20
/// times as long as the run. coarser: twice as large, which takes a tenth of the run, but misleads with a
/// tool of few cells, or with cells that happen to lie well.
enum class SecondSolution { coarser, finer };
inline const std::vector<std::string> second_solution_names = {"coarser", "finer"};

/// The scene with all steps twice or half as large. The cells are as nearly so as square ones divide the bed;
/// the device's loop is late by the same time. Error: input, if there are no such cells or ticks, or
/// check_scene() refuses them.
Scene second_scene(const Scene& scene, SecondSolution which);

/// Richardson's estimate. All parts of the method are of first order, so with steps r times as large the
/// error is r times as large, and the distance between two solutions gives it. start: the run's initial
/// surface; stroke: the run's stroke; force [N]: on the device, of every tick that the run reported. Error:
/// unstable, if the second solution is. map: a field of the run's cells; if given, it gets the error of each
/// height [m].
ErrorEstimate estimate_error(const Scene& scene, const HeightField& start,
                             const std::optional<Stroke>& stroke, const Solution& run,
                             const Kept<Eigen::Vector3d>& force, SecondSolution which,
                             HeightField* map = nullptr);

}  // namespace sandstroke
