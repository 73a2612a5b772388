#include "sweep/plan_axes.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <utility>

#include "core/elementary.h"
#include "core/input_file.h"
#include "io/key_reader.h"

namespace sandstroke {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_values = 1'000'000;  // of all axes: checking them takes two minutes

std::vector<std::string> as_literals(const std::vector<double>& numbers) {
  std::vector<std::string> literals;
  for (const double number : numbers) literals.push_back(fmt::format("{}", number));
  return literals;
}

/// A range, not sampled yet: `count` evenly spread values. count 0: any value between the ends.
struct AxisRange {
  double from = 0.0, to = 0.0;
  std::size_t count = 0;
  bool logarithmic = false;

  /// The value at 0 <= fraction < 1 of the range.
  double at(double fraction) const {
    return std::clamp(
        logarithmic ? from * elementary::pow(to / from, fraction) : from + (to - from) * fraction,
        std::min(from, to), std::max(from, to));
  }
};

AxisRange read_range(const TomlReader& toml, const std::string& key, int most) {
  RangeKeys keys;
  read_keys(toml, [&](KeyVisitor& visitor) { show_range(visitor, key, keys, most); });
  AxisRange range{keys.from, keys.to, static_cast<std::size_t>(keys.count.value_or(0)), keys.logarithmic};
  if (range.logarithmic && !(range.from > 0.0 && range.to > 0.0))
    toml.fail(key + ".scale", "is \"log\"; give from and to above 0");
  if (keys.count && keys.step) toml.fail(key, "has both count and step; give one of them");
  if (range.count == 1 && range.from != range.to)
    toml.fail(key + ".count", "is 1; give 2 or more, or a list with one value");
  if (!keys.step) return range;
  const double step = *keys.step;
  if (range.logarithmic) toml.fail(key + ".step", "cannot be used with scale = \"log\"; give count");
  if (step == 0.0) toml.fail(key + ".step", "is 0; give a step from `from` towards `to`");
  const double steps = std::floor((range.to - range.from) / step + 1e-9);
  if (!(steps >= 0.0))
    toml.fail(key + ".step", fmt::format("is {}, which goes away from `to`: from = {}, to = {}", step,
                                         range.from, range.to));
  if (steps >= most)
    toml.fail(key + ".step", fmt::format("gives {:.0f} values; sweep.max_points is {}", steps + 1.0, most));
  range.count = static_cast<std::size_t>(steps) + 1;
  range.to = rounded(range.from + steps * step, range.from);  // the end of the last step
  return range;
}

[[noreturn]] void refuse_so_many_values(const TomlReader& toml) {
  toml.fail("axes",
            fmt::format("have over {} values, and each must be checked; use fewer values", most_values));
}

void check_distinct(const TomlReader& toml, const std::string& key, const std::vector<std::string>& values) {
  if (std::set(values.begin(), values.end()).size() < values.size())
    toml.fail(key, "contains a value twice; give each value once");
}

/// The axis of sweep.strokes. None if the plan has no such key.
std::optional<SweepAxis> read_strokes(const TomlReader& toml, const PlanKeys& keys, const SweepPlan& plan) {
  const char* key = "sweep.strokes";
  if (!toml.has(key)) return std::nullopt;
  SweepAxis axis;
  axis.key = stroke_key;
  for (const std::string& stroke : keys.strokes) {
    const fs::path path = plan.file.parent_path() / stroke;
    check_readable(path);
    axis.values.push_back(
        toml_string(fs::relative(path, plan.scene_folder().empty() ? "." : plan.scene_folder()).string()));
  }
  if (axis.values.empty()) toml.fail(key, "is empty; name a stroke or remove it");
  check_distinct(toml, key, axis.values);
  for (const std::string table : {"set.", "axes."})
    if (toml.has(table + stroke_key))
      toml.fail(table + stroke_key, "is also in sweep.strokes; remove one of them");
  return axis;
}

/// Reads an axis. If it has no values of its own, they will be samples of the range.
std::pair<SweepAxis, AxisRange> read_axis(const TomlReader& toml, const std::string& name, bool grid,
                                          int most) {
  const std::string key = "axes." + name;
  if (toml.has("set." + name)) toml.fail(key, "is also in [set]; remove one of them");
  SweepAxis axis;
  axis.key = name;
  if (!toml.is_table(key)) {
    axis.values = toml.literals(key);
    if (axis.values.empty()) toml.fail(key, "is empty; give at least one value");
    return {axis, {}};
  }
  const AxisRange range = read_range(toml, key, most);
  axis.logarithmic = range.logarithmic;
  axis.of_range = true;
  if (range.count > most_values) refuse_so_many_values(toml);  // before their memory is taken
  if (range.count > 0)
    axis.values = as_literals(spread(range.from, range.to, range.count, range.logarithmic));
  else if (grid)
    toml.fail(key, "has no number of values; add count or step");
  return {axis, range};
}

void check_points(const TomlReader& toml, const SweepDesign& grid, int most) {
  double points = 1.0;
  for (const SweepAxis& axis : grid.axes) points *= static_cast<double>(axis.values.size());
  if (points > most)
    toml.fail("axes",
              fmt::format("give {:.0f} points and sweep.max_points is {}; take fewer values, or raise it",
                          points, most));
}

/// Samples the values of each axis, or its range if it has no values.
void sample(SweepDesign& latin, const std::vector<AxisRange>& ranges, std::size_t samples,
            std::uint32_t seed) {
  const auto fractions = latin_hypercube(latin.axes.size(), samples, seed);
  for (std::size_t i = 0; i < latin.axes.size(); ++i) {
    std::vector<std::string> values;
    const std::vector<std::string>& listed = latin.axes[i].values;
    for (const double fraction : fractions[i])
      values.push_back(listed.empty()
                           ? fmt::format("{:.12g}", ranges[i].at(fraction))
                           : listed[static_cast<std::size_t>(fraction * static_cast<double>(listed.size()))]);
    latin.axes[i].values = std::move(values);
  }
}

}  // namespace

SweepDesign read_design(const TomlReader& toml, const PlanKeys& keys, const SweepPlan& plan) {
  SweepDesign design;
  design.grid = keys.grid;
  std::size_t all_values = 0;
  const auto count_values = [&](std::size_t more) {
    if ((all_values += more) > most_values) refuse_so_many_values(toml);
  };
  std::vector<AxisRange> ranges;  // one for each axis
  if (std::optional<SweepAxis> strokes = read_strokes(toml, keys, plan)) {
    design.axes.push_back(std::move(*strokes));
    ranges.emplace_back();
  }
  for (const std::string& name : toml.keys_in("axes", {"from", "to", "step", "count"})) {
    auto [axis, range] = read_axis(toml, name, design.grid, keys.max_points);
    count_values(axis.values.size());
    check_distinct(toml, "axes." + name, axis.values);
    design.axes.push_back(std::move(axis));
    ranges.push_back(range);
  }
  if (design.axes.empty())
    toml.fail("axes",
              "is missing or empty; name the settings to vary, such as [axes] force.k_s = [500, 1000]");

  if (design.grid) {
    check_points(toml, design, keys.max_points);
    return design;
  }
  const auto samples = static_cast<std::size_t>(keys.samples);
  count_values(design.axes.size() * samples);
  sample(design, ranges, samples, static_cast<std::uint32_t>(keys.seed));
  return design;
}

}  // namespace sandstroke
