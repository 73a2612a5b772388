#pragma once

#include <string>

#include "validation/study/contact_scene.h"
#include "validation/study/problem.h"

namespace sandstroke {

/// A scene of force.law = "rft" whose sand yields at once (0.001 mm), so that force.yield adds no error to
/// that of the cells [m]. Sand does not relax.
Scene force_scene(const ToolSettings& tool, double cell, double tool_friction);

/// The stroke goes straight down to `depth` [m] at 50 mm/s, and then `drag` [m] along x. With cells of `cell`
/// [m] it lies off every grid line.
Stroke push(double cell, double depth, double drag);

/// A tool that stands `depth` [m] deep from the first tick, and moves just so far along `direction` that the
/// sand yields. Off every grid line, too.
Stroke nudge(double cell, double depth, const Eigen::Vector3d& direction);

/// Compares the force along `axis` in the last tick with `exact` [N]. step: Contender::step.
Contender force_contender(const std::string& series, const std::string& label, const Scene& scene,
                          const HeightField& bed, int threads, double step, const Stroke& stroke, int axis,
                          double exact);

/// A problem whose error is that of a force.
Problem force_problem(const char* name, const char* title, const char* text);

}  // namespace sandstroke
