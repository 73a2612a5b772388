#include "pages/curves.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>

#include "haptics/passivity.h"
#include "measure/force_agreement.h"
#include "report/curve.h"

namespace sandstroke {
namespace {

using Json = nlohmann::ordered_json;

/// A number per tick of a trace, and the distance between two of them.
struct Quantity {
  std::string group, name, unit;
  double limit;
  std::function<double(const TickRecord&)> value;
  std::function<double(const TickRecord& golden, const TickRecord& run)> difference;
  std::function<double(const TickRecord&)> recorded = {};  ///< with the stroke; empty: it is no force
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
                             },
                             [](const TickRecord& tick) { return tick.recorded_force.norm(); }}};
  for (const int axis : {0, 1, 2}) {
    all.push_back(number("Force on the device", fmt::format("along {}", "xyz"[axis]), "N", tolerances.force,
                         [axis](const TickRecord& tick) { return tick.device_force[axis]; }));
    all.back().recorded = [axis](const TickRecord& tick) { return tick.recorded_force[axis]; };
  }
  // In the air, a hand's height would squash the depths of a few millimetres that count.
  all.push_back(number("Tool in the sand", "depth", "mm", 1e3 * tolerances.depth,
                       [](const TickRecord& tick) { return 1e3 * tick.depth; }));
  all.back().value = [](const TickRecord& tick) { return 1e3 * (tick.depth < 0.0 ? 0.0 : tick.depth); };
  all.push_back(number("Tool in the sand", "sand level", "mm", 1e3 * tolerances.depth,
                       [](const TickRecord& tick) { return 1e3 * tick.level; }));
  return all;
}

template <class Value>
Json curve_over_time(const std::vector<TickRecord>& trace, std::size_t ticks, const Value& value) {
  Curve curve;
  for (std::size_t tick = 0; tick < ticks; ++tick) curve.add(trace[tick].time, value(tick));
  return curve_json(curve);
}

/// Adds the force that was recorded with the stroke, if there is one.
void add_recorded(Json& json, const Quantity& quantity, const std::vector<TickRecord>& trace) {
  const auto is_known = [](const TickRecord& tick) { return !std::isnan(tick.recorded_force.x()); };
  if (quantity.recorded && std::any_of(trace.begin(), trace.end(), is_known))
    json["recorded"] = curve_over_time(trace, trace.size(),
                                       [&](std::size_t tick) { return quantity.recorded(trace[tick]); });
}

std::string text(const std::optional<std::vector<TickRecord>>& golden,
                 const std::optional<std::vector<TickRecord>>& run) {
  const auto ticks = [](const std::optional<std::vector<TickRecord>>& trace) {
    if (!trace) return std::string("no trace");
    return fmt::format("{} ticks", trace->size());
  };
  return fmt::format("Golden: {}; run: {}. {}", ticks(golden), ticks(run), curves_are_thinned);
}

}  // namespace

std::vector<double> absorbed_energy(const std::vector<TickRecord>& trace) {
  EnergyAccount account;
  std::vector<double> energy;
  for (std::size_t tick = 0; tick < trace.size(); ++tick) {
    if (tick > 0)
      account.add(trace[tick - 1].device_force,
                  trace[tick].device_position - trace[tick - 1].device_position);
    energy.push_back(account.absorbed());
  }
  return energy;
}

Json traces_part(const std::optional<std::vector<TickRecord>>& golden,
                 const std::optional<std::vector<TickRecord>>& run, const Tolerances& tolerances) {
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
    const auto add = [&](const char* name, const std::optional<std::vector<TickRecord>>& trace) {
      if (!trace) return;
      json[name] = curve_over_time(*trace, trace->size(),
                                   [&](std::size_t tick) { return quantity.value((*trace)[tick]); });
    };
    add("golden", golden);
    add("run", run);
    if (run) add_recorded(json, quantity, *run);
    if (golden && run) {
      json["difference"] = curve_over_time(
          *golden, std::min(golden->size(), run->size()),
          [&](std::size_t tick) { return quantity.difference((*golden)[tick], (*run)[tick]); });
    }
    part["quantities"].push_back(std::move(json));
  }
  return part;
}

Json traces_part(const std::vector<TickRecord>& trace) {
  std::string text = fmt::format("{} ticks. {}", trace.size(), curves_are_thinned);
  std::vector<ForcePair> forces;
  for (const TickRecord& tick : trace) forces.push_back(forces_of(tick));
  if (const std::optional<ForceAgreement> agreement = force_agreement(forces))
    text += fmt::format(" The recorded force {}.", text_of(*agreement));
  Json part{{"kind", "traces"},
            {"title", "Force, depth and energy over time"},
            {"text", text},
            {"quantities", Json::array()}};
  const auto add = [&](const std::string& group, const std::string& name, const std::string& unit,
                       const std::function<double(std::size_t)>& value) -> Json& {
    return part["quantities"].emplace_back(Json{{"group", group},
                                                {"name", name},
                                                {"unit", unit},
                                                {"run", curve_over_time(trace, trace.size(), value)}});
  };
  for (const Quantity& quantity : quantities({}))
    add_recorded(add(quantity.group, quantity.name, quantity.unit,
                     [&](std::size_t tick) { return quantity.value(trace[tick]); }),
                 quantity, trace);
  const auto has_torque = [](const TickRecord& tick) { return !tick.wrench.torque.isZero(0.0); };
  if (std::any_of(trace.begin(), trace.end(), has_torque))
    for (const int axis : {0, 1, 2})
      add("Torque on the tool about its tip", fmt::format("about {}", "xyz"[axis]), "N m",
          [&, axis](std::size_t tick) { return trace[tick].wrench.torque[axis]; });
  const std::vector<double> energy = absorbed_energy(trace);
  add("Energy given to the sand", "energy", "J", [&](std::size_t tick) { return energy[tick]; });
  return part;
}

}  // namespace sandstroke
