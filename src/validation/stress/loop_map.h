#pragma once

#include <functional>
#include <utility>

#include "validation/stress/device_loop.h"
#include "validation/stress/loop_margins.h"

namespace sandstroke {

/// A map of the device loop to be drawn.
struct LoopMapPlan {
  std::string name, title, text;
  MapAxis x, y;
  std::function<LoopSettings(double x, double y)> loop;
  std::function<std::int64_t(const LoopSettings&)> ticks;
  /// True if a run contradicts theory.
  std::function<bool(const LoopSettings&, const LoopRun&, std::int64_t ticks)> surprising;
  /// Curves. Each runs where its function of the loop changes its sign along y.
  std::vector<std::pair<std::string, std::function<double(const LoopSettings&)>>> curves;
  std::vector<MarkedLoop> marked = known_loops();
};

/// How the values of an axis are spread. linear: at even distances. logarithmic: at even ratios.
enum class AxisScale { linear, logarithmic };

/// An axis of `count` values from low to high.
MapAxis map_axis(std::string name, std::string unit, AxisScale scale, double low, double high, int count);

/// Runs every cell, rows in parallel. The result is the same for any number of threads.
StabilityMap draw_map(const LoopMapPlan& plan);

}  // namespace sandstroke
