#pragma once

#include <functional>
#include <utility>

#include "validation/stress/device_loop.h"

namespace sandstroke {

/// A map of the device loop to be drawn.
struct LoopMapPlan {
  std::string name, title, text;
  MapAxis x, y;
  std::function<LoopSettings(double x, double y)> loop;
  std::function<std::int64_t(const LoopSettings&)> ticks;
  /// True where a run is not as theory has it.
  std::function<bool(const LoopSettings&, const LoopRun&, std::int64_t ticks)> surprising;
  /// Curves, each where a value of the loop's changes its sign along y.
  std::vector<std::pair<std::string, std::function<double(const LoopSettings&)>>> curves;
};

/// `count` values from low to high, evenly or, logarithmic, by even ratios.
MapAxis map_axis(std::string name, std::string unit, bool logarithmic, double low, double high, int count);

/// Runs every cell, rows in parallel; the same for any number of threads.
StabilityMap draw_map(const LoopMapPlan& plan);

}  // namespace sandstroke
