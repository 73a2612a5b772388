#include "compare/trace_difference.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"

namespace sandstroke {
namespace {

void require_columns(const RunTrace& trace, const char* which) {
  const auto require = [&](const char* column, std::size_t size) {
    if (size != trace.size()) {
      throw_input_error("the {} trace has {} values of '{}' for {} ticks; make it again", which, size, column,
                        trace.size());
    }
  };
  require("device_force", trace.device_force.size());
  require("depth", trace.depth.size());
  require("level", trace.level.size());
  require("contact", trace.contact.size());
}

}  // namespace

TraceDifference trace_difference(const RunTrace& golden, const RunTrace& run) {
  require_columns(golden, "golden");
  require_columns(run, "compared");

  const auto largest = [&](const auto& distance) {
    ColumnDifference result;
    const std::size_t ticks = std::min(golden.size(), run.size());
    for (std::size_t tick = 0; tick < ticks && !std::isnan(result.max); ++tick) {
      const double d = distance(tick);
      if (d <= result.max) continue;
      result.max = d;
      result.tick = tick;
    }
    if (ticks > 0) result.time = golden.time[result.tick];
    return result;
  };
  TraceDifference result;
  result.time = largest([&](std::size_t tick) { return std::abs(run.time[tick] - golden.time[tick]); });
  result.force =
      largest([&](std::size_t tick) { return (run.device_force[tick] - golden.device_force[tick]).norm(); });
  result.depth = largest([&](std::size_t tick) { return std::abs(run.depth[tick] - golden.depth[tick]); });
  result.level = largest([&](std::size_t tick) {
    const bool lifted = golden.contact[tick] == 0 && run.contact[tick] == 0;
    if (lifted && std::isnan(golden.level[tick]) && std::isnan(run.level[tick])) return 0.0;
    return std::abs(run.level[tick] - golden.level[tick]);
  });
  return result;
}

}  // namespace sandstroke
