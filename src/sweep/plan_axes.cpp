#include "sweep/plan_axes.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <set>
#include <utility>

#include "core/output_file.h"

namespace sandstroke {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_values = 1'000'000;  // of all axes: to try them all takes two minutes

std::vector<std::string> as_literals(const std::vector<double>& numbers) {
  std::vector<std::string> literals;
  for (const double number : numbers) literals.push_back(fmt::format("{}", number));
  return literals;
}

/// A range, not sampled yet: `count` values evenly spread, or, where that is 0, any between its ends.
struct AxisRange {
  double from = 0.0, to = 0.0;
  std::size_t count = 0;
  bool logarithmic = false;

  /// At 0 <= share < 1 of it.
  double at(double share) const {
    return std::clamp(logarithmic ? from * std::pow(to / from, share) : from + (to - from) * share,
                      std::min(from, to), std::max(from, to));
  }
};

AxisRange read_range(const TomlReader& toml, const std::string& key, int most) {
  AxisRange range;
  for (const char* end : {".from", ".to"}) toml.require(key + end);
  range.from = toml.number(key + ".from", 0.0);
  range.to = toml.number(key + ".to", 0.0);
  range.logarithmic = toml.choice(key + ".scale", 0, {"linear", "log"}) == 1;
  if (range.logarithmic && !(range.from > 0.0 && range.to > 0.0))
    toml.fail(key + ".scale", "is \"log\"; give from and to above 0");
  if (toml.has(key + ".count") && toml.has(key + ".step"))
    toml.fail(key, "has both count and step; give one of them");
  if (toml.has(key + ".count")) {
    range.count = static_cast<std::size_t>(toml.integer(key + ".count", 1, 1, most));
    if (range.count == 1 && range.from != range.to)
      toml.fail(key + ".count", "is 1; give 2 or more, or a list with one value");
  }
  if (!toml.has(key + ".step")) return range;
  const double step = toml.number(key + ".step", 1.0);
  if (range.logarithmic) toml.fail(key + ".step", "does not go with scale = \"log\"; give count");
  if (step == 0.0) toml.fail(key + ".step", "is 0; give one that leads from `from` to `to`");
  const double steps = std::floor((range.to - range.from) / step + 1e-9);
  if (!(steps >= 0.0))
    toml.fail(key + ".step",
              fmt::format("is {}, which does not lead from {} to {}", step, range.from, range.to));
  if (steps >= most)
    toml.fail(key + ".step", fmt::format("gives {:.0f} values; sweep.max_points is {}", steps + 1.0, most));
  range.count = static_cast<std::size_t>(steps) + 1;
  range.to = rounded(range.from + steps * step, range.from);  // the last step's end
  return range;
}

void check_distinct(const TomlReader& toml, const std::string& key, const std::vector<std::string>& values) {
  if (std::set(values.begin(), values.end()).size() < values.size())
    toml.fail(key, "has a value twice; give each once");
}

/// The axis of sweep.strokes; none where they are not given.
std::optional<SweepAxis> read_strokes(const TomlReader& toml, const SweepPlan& plan) {
  const char* key = "sweep.strokes";
  if (!toml.has(key)) return std::nullopt;
  SweepAxis axis{stroke_key, "", false, {}};
  for (const std::string& stroke : toml.texts(key, {})) {
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

/// An axis, and the range of which its values are to be samples, where it has none of its own.
std::pair<SweepAxis, AxisRange> read_axis(const TomlReader& toml, const std::string& name, bool grid,
                                          int most) {
  const std::string key = "axes." + name;
  if (toml.has("set." + name)) toml.fail(key, "is also in [set]; remove one of them");
  SweepAxis axis{name, "", false, {}};
  if (!toml.is_table(key)) {
    axis.values = toml.literals(key);
    if (axis.values.empty()) toml.fail(key, "is empty; give at least one value");
    return {axis, {}};
  }
  const AxisRange range = read_range(toml, key, most);
  axis.logarithmic = range.logarithmic;
  if (range.count > 0)
    axis.values = as_literals(spread(range.from, range.to, range.count, range.logarithmic));
  else if (grid)
    toml.fail(key, "says not how many values; add count or step");
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

/// Samples each axis' values, or its range where it has none.
void sample(SweepDesign& latin, const std::vector<AxisRange>& ranges, std::size_t samples,
            std::uint32_t seed) {
  const auto shares = latin_hypercube(latin.axes.size(), samples, seed);
  for (std::size_t i = 0; i < latin.axes.size(); ++i) {
    std::vector<std::string> values;
    const std::vector<std::string>& listed = latin.axes[i].values;
    for (const double share : shares[i])
      values.push_back(listed.empty()
                           ? fmt::format("{:.12g}", ranges[i].at(share))
                           : listed[static_cast<std::size_t>(share * static_cast<double>(listed.size()))]);
    latin.axes[i].values = std::move(values);
  }
}

}  // namespace

SweepDesign read_design(const TomlReader& toml, const SweepPlan& plan) {
  SweepDesign design;
  design.grid = toml.choice("sweep.design", 0, {"grid", "latin"}) == 0;
  const int most = toml.integer("sweep.max_points", 10'000, 1, 10'000'000);
  if (!design.grid) toml.require("sweep.samples");
  const auto samples = static_cast<std::size_t>(toml.integer("sweep.samples", 1, 1, most));
  const auto seed =
      static_cast<std::uint32_t>(toml.integer("sweep.seed", 1, 0, std::numeric_limits<int>::max()));
  for (const char* key : {"sweep.samples", "sweep.seed"})
    if (design.grid && toml.has(key)) toml.fail(key, "is for design = \"latin\"; remove it or set that");

  std::size_t all_values = 0;
  const auto count_values = [&](std::size_t more) {
    if ((all_values += more) > most_values)
      toml.fail("axes", fmt::format("give over {} values, each to be tried; take fewer", most_values));
  };
  std::vector<AxisRange> ranges;  // of each axis
  if (std::optional<SweepAxis> strokes = read_strokes(toml, plan)) {
    design.axes.push_back(std::move(*strokes));
    ranges.emplace_back();
  }
  for (const std::string& name : toml.keys_in("axes", {"from", "to", "step", "count"})) {
    auto [axis, range] = read_axis(toml, name, design.grid, most);
    count_values(axis.values.size());
    check_distinct(toml, "axes." + name, axis.values);
    design.axes.push_back(std::move(axis));
    ranges.push_back(range);
  }
  if (design.axes.empty())
    toml.fail("axes", "is missing or empty; say what varies, such as [axes] force.k_s = [500, 1000]");

  if (design.grid) {
    check_points(toml, design, most);
    return design;
  }
  count_values(design.axes.size() * samples);
  sample(design, ranges, samples, seed);
  return design;
}

}  // namespace sandstroke
