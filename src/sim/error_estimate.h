#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "sim/solution.h"

namespace sandstroke {

/// The second solution that a run is held against: every step half as large (10 to 20 times the run), or
/// twice as large (a tenth of the run, but fooled by a tool of few cells, or by cells that happen to lie
/// well).
enum class SecondSolution { coarser, finer };
inline const std::vector<std::string> second_solution_names = {"coarser", "finer"};

/// The scene with all steps twice or half as large; cells as nearly as square ones divide the bed; the
/// device's loop as late. Error: input, where there are no such cells, or check_scene() refuses them, or no
/// such ticks.
Scene second_scene(const Scene& scene, SecondSolution which);

/// Richardson's estimate: all parts of the method are of first order, so that with steps r times as large the
/// error is r times as large, and the distance between two solutions tells it. start: the run's initial
/// surface; stroke: as the run had it; force [N]: on the device, of every tick that the run told. Error:
/// unstable, where the second solution is. map: where given, of the run's cells, gets the error of each
/// height [m].
ErrorEstimate estimate_error(const Scene& scene, const HeightField& start,
                             const std::optional<Stroke>& stroke, const Solution& run,
                             const Kept<Eigen::Vector3d>& force, SecondSolution which,
                             HeightField* map = nullptr);

}  // namespace sandstroke
