#pragma once

#include "validation/stress/stress_report.h"

namespace sandstroke {

/// All parts, one after the other; what is missing where it was interrupted() is no surprise.
StressReport stress_all(const StressOptions& options);

// The parts of the stress test. Each adds its cases, maps, boundaries and traces to the report.

/// The haptic loop against wall and sand: where it is stable, swings or diverges.
void stress_device_loop(StressReport& report, const StressOptions& options);
/// Beds that no one would draw.
void stress_relaxation(StressReport& report, const StressOptions& options);
/// Strokes that no hand would make.
void stress_strokes(StressReport& report, const StressOptions& options);

}  // namespace sandstroke
