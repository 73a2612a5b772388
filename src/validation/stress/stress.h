#pragma once

#include "validation/stress/device_loop.h"
#include "validation/stress/stress_report.h"

namespace sandstroke {

/// Runs all parts, one after the other. Parts missing after interrupted() are no surprise.
StressReport stress_all(const StressOptions& options);

/// Judges one loop with exact encoders, such as a scene's (scene_loop.h): its margins, and maps of its
/// settings about their own values.
StressReport stress_scene(const LoopSettings& own, const StressOptions& options);

// The parts of the stress test. Each adds cases, maps, boundaries and traces to the report.

/// Seeks where the haptic loop, against wall and sand, is stable, swings or diverges.
void stress_device_loop(StressReport& report, const StressOptions& options);
/// Relaxes beds that no user would draw.
void stress_relaxation(StressReport& report, const StressOptions& options);
/// Lays sand on floors and stones, and makes it of kinds, as no user would.
void stress_grounds(StressReport& report, const StressOptions& options);
/// Pours and takes sand as no nozzle would.
void stress_sources(StressReport& report, const StressOptions& options);
/// Takes tools into stones.
void stress_stone_strokes(StressReport& report, const StressOptions& options);
/// Draws whole scenes with grounds, sources and strokes at random.
void stress_any_ground(StressReport& report, const StressOptions& options);
/// Takes tools round closed loops in sand.
void stress_contact_loops(StressReport& report, const StressOptions& options);
/// Runs strokes that no hand would make.
void stress_strokes(StressReport& report, const StressOptions& options);

}  // namespace sandstroke
