#include "validation/stress/loop_map.h"

#include <cmath>
#include <optional>

#include "core/bisection.h"
#include "core/parallel.h"
#include "validation/stress/loop_margins.h"

namespace sandstroke {
namespace {

/// The lowest position on the axis where value(y) changes its sign between neighbouring values.
template <class Value>
std::optional<double> sign_change(const MapAxis& axis, const Value& value) {
  for (std::size_t i = 0; i + 1 < axis.values.size(); ++i) {
    const double low = axis.values[i], high = axis.values[i + 1];
    const bool positive = value(low) > 0.0;
    if ((value(high) > 0.0) == positive) continue;
    return boundary_between(low, high, 12, axis.logarithmic ? geometric_mean : mean,
                            [&](double y) { return (value(y) > 0.0) == positive; });
  }
  return std::nullopt;
}

}  // namespace

MapAxis map_axis(std::string name, std::string unit, AxisScale scale, double low, double high, int count) {
  const bool logarithmic = scale == AxisScale::logarithmic;
  MapAxis axis{std::move(name), std::move(unit), logarithmic, {}};
  for (int i = 0; i < count; ++i) {
    const double fraction = static_cast<double>(i) / (count - 1);
    axis.values.push_back(logarithmic ? low * std::pow(high / low, fraction) : low + (high - low) * fraction);
  }
  return axis;
}

StabilityMap draw_map(const LoopMapPlan& plan) {
  const std::size_t rows = plan.y.values.size(), cols = plan.x.values.size();
  StabilityMap map{plan.name, plan.title, plan.text, plan.x, plan.y, {}, {}, {}, {}};
  map.verdict.assign(rows, std::vector<Verdict>(cols));
  map.surprise.assign(rows, std::vector<bool>(cols));
  parallel_for(rows, [&](std::size_t row) {
    for (std::size_t col = 0; col < cols; ++col) {
      const LoopSettings loop = plan.loop(plan.x.values[col], plan.y.values[row]);
      const std::int64_t ticks = plan.ticks(loop);
      const LoopRun run = run_loop(loop, ticks);
      map.verdict[row][col] = run.verdict;
      map.surprise[row][col] = plan.surprising(loop, run, ticks);
    }
  });
  std::vector<std::vector<std::optional<double>>> crossing(plan.curves.size(),
                                                           std::vector<std::optional<double>>(cols));
  parallel_for(plan.curves.size() * cols, [&](std::size_t i) {
    const double x = plan.x.values[i % cols];
    crossing[i / cols][i % cols] =
        sign_change(plan.y, [&](double y) { return plan.curves[i / cols].second(plan.loop(x, y)); });
  });
  for (std::size_t curve = 0; curve < plan.curves.size(); ++curve) {
    MapCurve& drawn = map.curves.emplace_back(MapCurve{plan.curves[curve].first, {}});
    for (std::size_t col = 0; col < cols; ++col)
      if (crossing[curve][col]) drawn.points.emplace_back(plan.x.values[col], *crossing[curve][col]);
  }
  map.marks = marks_in(plan.x, plan.y, plan.loop, plan.marked);
  return map;
}

}  // namespace sandstroke
