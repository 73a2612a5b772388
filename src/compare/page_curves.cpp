#include "compare/page_curves.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>

namespace sandstroke {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t most_points = 2000;  // of a curve

/// A number per tick of a trace, and how far two of them are apart.
struct Quantity {
  std::string group, name, unit;
  double limit;
  std::function<double(const TickRecord&)> value;
  std::function<double(const TickRecord& golden, const TickRecord& run)> difference;
};

std::vector<Quantity> quantities(const Tolerances& tolerances) {
  const auto number = [](const std::string& group, const std::string& name, const std::string& unit,
                         double limit, const std::function<double(const TickRecord&)>& value) {
    return Quantity{group,
                    name,
                    unit,
                    limit,
                    value,
                    [value](const TickRecord& golden, const TickRecord& run) {
                      return value(run) - value(golden); }};
  };
  std::vector<Quantity> all{{"Force on the device", "magnitude", "N", tolerances.force,
                             [](const TickRecord& tick) { return tick.device_force.norm(); },
                             [](const TickRecord& golden, const TickRecord& run) {
                               return (run.device_force - golden.device_force).norm();
                             }}};
  for (const int axis : {0, 1, 2}) {
    all.push_back(number("Force on the device", fmt::format("along {}", "xyz"[axis]), "N", tolerances.force,
                         [axis](const TickRecord& tick) { return tick.device_force[axis]; }));
  }
  all.push_back(number("Tool in the sand", "depth", "m", tolerances.depth,
                       [](const TickRecord& tick) { return tick.depth; }));
  all.push_back(number("Tool in the sand", "sand level", "m", tolerances.depth,
                       [](const TickRecord& tick) { return tick.level; }));
  return all;
}

template <class Value>
Json curve_json(const std::vector<TickRecord>& trace, std::size_t ticks, const Value& value) {
  Curve curve;
  for (std::size_t tick = 0; tick < ticks; ++tick) {
    curve.time.push_back(trace[tick].time);
    curve.value.push_back(value(tick));
  }
  curve = thinned_curve(curve, most_points);
  return {{"time", std::move(curve.time)}, {"value", std::move(curve.value)}};
}

std::string text(const std::optional<CountedTrace>& golden, const std::optional<CountedTrace>& run) {
  const auto ticks = [](const std::optional<CountedTrace>& trace) {
    if (!trace) return std::string("no trace");
    const std::size_t kept = trace->rows.size();
    return kept == trace->ticks ? fmt::format("{} ticks", kept)
                                : fmt::format("{} of {} ticks kept", kept, trace->ticks);
  };
  return fmt::format(
      "Golden: {}; run: {}. A curve with more than {} points shows of each stretch of time the least and the "
      "greatest value, so that no extreme is lost.",
      ticks(golden), ticks(run), most_points);
}

}  // namespace

Curve thinned_curve(const Curve& curve, std::size_t most) {
  const std::size_t points = curve.value.size();
  if (points <= most) return curve;
  Curve kept;
  const auto keep = [&](std::size_t i) {
    kept.time.push_back(curve.time[i]);
    kept.value.push_back(curve.value[i]);
  };
  const std::size_t stretches = std::max<std::size_t>(1, most / 2);
  for (std::size_t k = 0; k < stretches; ++k) {
    const std::size_t begin = k * points / stretches, end = (k + 1) * points / stretches;
    std::optional<std::size_t> least, greatest, gap;
    for (std::size_t i = begin; i < end; ++i) {
      const double value = curve.value[i];
      if (!std::isfinite(value)) {
        if (!gap) gap = i;
        continue;
      }
      if (!least || value < curve.value[*least]) least = i;
      if (!greatest || value > curve.value[*greatest]) greatest = i;
    }
    std::vector<std::size_t> chosen;
    for (const std::optional<std::size_t>& one : {least, greatest, gap})
      if (one) chosen.push_back(*one);
    std::sort(chosen.begin(), chosen.end());
    chosen.erase(std::unique(chosen.begin(), chosen.end()), chosen.end());
    for (const std::size_t i : chosen) keep(i);
  }
  return kept;
}

Json traces_part(const std::optional<CountedTrace>& golden, const std::optional<CountedTrace>& run,
                 const Tolerances& tolerances) {
  if (!golden && !run) return nullptr;
  Json part{{"kind", "traces"},
            {"title", "Force and depth over time"},
            {"text", text(golden, run)},
            {"quantities", Json::array()}};
  for (const Quantity& quantity : quantities(tolerances)) {
    Json json{{"group", quantity.group},
              {"name", quantity.name},
              {"unit", quantity.unit},
              {"limit", quantity.limit}};
    const auto add = [&](const char* name, const std::optional<CountedTrace>& trace) {
      if (!trace) return;
      json[name] = curve_json(trace->rows, trace->rows.size(),
                              [&](std::size_t tick) { return quantity.value(trace->rows[tick]); });
    };
    add("golden", golden);
    add("run", run);
    if (golden && run) {
      json["difference"] = curve_json(
          golden->rows, std::min(golden->rows.size(), run->rows.size()),
          [&](std::size_t tick) { return quantity.difference(golden->rows[tick], run->rows[tick]); });
    }
    part["quantities"].push_back(std::move(json));
  }
  return part;
}

}  // namespace sandstroke
