#include "sweep/sweep_plan.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "core/error.h"
#include "core/output_file.h"
#include "io/input_kind.h"
#include "io/scene_keys.h"
#include "io/scene_toml.h"
#include "io/toml_reader.h"
#include "sweep/metrics.h"

namespace sandstroke {
namespace {

namespace fs = std::filesystem;

const std::string stroke_key = "stroke.file";
constexpr std::size_t most_values =
    1'000'000;  // of all axes: each is tried in a scene, which takes two minutes

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

/// The plan's axes; those of a Latin design are sampled.
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

  const auto check_distinct = [&](const std::string& key, const std::vector<std::string>& values) {
    if (std::set(values.begin(), values.end()).size() < values.size())
      toml.fail(key, "has a value twice; give each once");
  };
  std::size_t all_values = 0;
  const auto count_values = [&](std::size_t more) {
    if ((all_values += more) > most_values)
      toml.fail("axes", fmt::format("give over {} values, each to be tried; take fewer", most_values));
  };
  std::vector<AxisRange> ranges;
  if (const auto strokes = toml.texts("sweep.strokes", {}); !strokes.empty()) {
    SweepAxis axis{stroke_key, "", false, {}};
    for (const std::string& stroke : strokes) {
      const fs::path path = plan.file.parent_path() / stroke;
      check_readable(path);
      axis.values.push_back(
          toml_string(fs::relative(path, plan.scene_folder().empty() ? "." : plan.scene_folder()).string()));
    }
    check_distinct("sweep.strokes", axis.values);
    if (toml.has("set." + stroke_key))
      toml.fail("set." + stroke_key, "is also in sweep.strokes; remove one of them");
    design.axes.push_back(std::move(axis));
    ranges.emplace_back();
  } else if (toml.has("sweep.strokes")) {
    toml.fail("sweep.strokes", "is empty; name a stroke or remove it");
  }
  for (const std::string& name : toml.keys_in("axes", {"from", "to", "step", "count"})) {
    const std::string key = "axes." + name;
    if (toml.has("set." + name)) toml.fail(key, "is also in [set]; remove one of them");
    if (name == stroke_key && toml.has("sweep.strokes"))
      toml.fail(key, "is also in sweep.strokes; remove one of them");
    SweepAxis axis{name, "", false, {}};
    AxisRange range;
    if (toml.is_table(key)) {
      range = read_range(toml, key, most);
      axis.logarithmic = range.logarithmic;
      if (range.count > 0)
        axis.values = as_literals(spread(range.from, range.to, range.count, range.logarithmic));
      else if (design.grid)
        toml.fail(key, "says not how many values; add count or step");
    } else {
      axis.values = toml.literals(key);
      if (axis.values.empty()) toml.fail(key, "is empty; give at least one value");
    }
    count_values(axis.values.size());
    check_distinct(key, axis.values);
    design.axes.push_back(std::move(axis));
    ranges.push_back(range);
  }
  if (design.axes.empty())
    toml.fail("axes", "is missing or empty; say what varies, such as [axes] force.k_s = [500, 1000]");

  if (design.grid) {
    double points = 1.0;
    for (const SweepAxis& axis : design.axes) points *= static_cast<double>(axis.values.size());
    if (points > most)
      toml.fail("axes",
                fmt::format("give {:.0f} points and sweep.max_points is {}; take fewer values, or raise it",
                            points, most));
    return design;
  }
  for (std::size_t i = 0; i < design.axes.size(); ++i) count_values(samples);
  const auto sampled = latin_hypercube(design.axes.size(), samples, seed);
  for (std::size_t i = 0; i < design.axes.size(); ++i) {
    std::vector<std::string> values;
    const std::vector<std::string>& listed = design.axes[i].values;
    for (const double share : sampled[i])
      values.push_back(listed.empty()
                           ? fmt::format("{:.12g}", ranges[i].at(share))
                           : listed[static_cast<std::size_t>(share * static_cast<double>(listed.size()))]);
    design.axes[i].values = std::move(values);
  }
  return design;
}

std::vector<std::string> read_metrics(const TomlReader& toml) {
  std::vector<std::string> known;  // but for those that lack what they need
  const bool golden = toml.has("sweep.golden");
  for (const Metric& metric : all_metrics())
    if (golden || !metric.needs_golden) known.push_back(metric.name);
  const std::vector<std::string> metrics = toml.texts("sweep.metrics", known);
  if (metrics.empty()) toml.fail("sweep.metrics", "is empty; name one or remove it");
  for (const std::string& metric : metrics) {
    if (std::find(known.begin(), known.end(), metric) == known.end())
      toml.fail("sweep.metrics", fmt::format("names '{}'; take from: {}{}", metric, fmt::join(known, ", "),
                                             golden ? "" : " (and with sweep.golden what differs from it)"));
    if (std::count(metrics.begin(), metrics.end(), metric) > 1)
      toml.fail("sweep.metrics", fmt::format("names '{}' twice; name it once", metric));
  }
  return metrics;
}

/// Tries a scene; what is wrong with it is said of the plan's key that gave the setting.
Scene try_scene(const TomlReader& toml, const SweepPlan& plan, const std::vector<std::string>& settings,
                const std::string& tried_key) {
  try {
    return plan.scene_with(settings);
  } catch (const Error& failure) {
    const std::string sentence = failure.what();
    for (const std::string& setting : settings) {
      const std::string start = "--set " + setting + ": ";
      if (!sentence.starts_with(start)) continue;
      const std::string key = setting.substr(0, setting.find('='));
      const std::string table = toml.has("set." + key) ? "set." : "axes.";
      toml.fail(
          key == stroke_key ? "sweep.strokes" : table + key,
          fmt::format("cannot be {}: {}", setting.substr(key.size() + 1), sentence.substr(start.size())));
    }
    if (tried_key.empty()) throw;
    toml.fail(tried_key, "leads to a scene that cannot be: " + sentence);
  }
}

/// Whatever its axes.
bool fails_without_axes(const SweepPlan& plan) {
  try {
    plan.scene_with(plan.settings);
    return false;
  } catch (const Error&) {
    return true;
  }
}

/// Each value of each axis, beside the first of the others.
void check_values(const TomlReader& toml, SweepPlan& plan) {
  std::vector<std::string> firsts = plan.settings;
  for (const std::string& setting : plan.design.settings(0)) firsts.push_back(setting);
  const Scene scene = try_scene(toml, plan, firsts, fails_without_axes(plan) ? "" : "axes");
  for (std::size_t i = 0; i < plan.design.axes.size(); ++i) {
    SweepAxis& axis = plan.design.axes[i];
    axis.unit = setting_unit(scene, axis.key);
    for (std::size_t value = 1; value < axis.values.size(); ++value) {
      std::vector<std::string> settings = firsts;
      settings[plan.settings.size() + i] = axis.key + "=" + axis.values[value];
      try_scene(toml, plan, settings, axis.key == stroke_key ? "sweep.strokes" : "axes." + axis.key);
    }
  }
}

}  // namespace

Scene SweepPlan::scene_with(const std::vector<std::string>& all_settings) const {
  return scene_from_text(scene_text, scene.string(), all_settings);
}

Scene SweepPlan::scene_of(std::size_t point) const {
  std::vector<std::string> all = settings;
  for (const std::string& setting : design.settings(point)) all.push_back(setting);
  return scene_with(all);
}

std::string plan_help() {
  std::vector<std::string> metrics;
  for (const Metric& metric : all_metrics()) metrics.push_back(metric.name);
  std::string lines;
  for (std::size_t i = 0; i < metrics.size(); i += 6)
    lines += fmt::format(
        "  {}\n",
        fmt::join(metrics.begin() + static_cast<std::ptrdiff_t>(i),
                  metrics.begin() + static_cast<std::ptrdiff_t>(std::min(i + 6, metrics.size())), " "));
  return R"(A plan (TOML; only scene and one axis are needed; files are relative to the plan):
  [sweep]
  scene = "scene.toml"                 # what every point starts from
  strokes = ["a.toml", "b.h5"]         # instead of the scene's; the first axis
  design = "grid"                      # every combination; or "latin": a Latin hypercube of
  samples = 200                        #   so many points
  seed = 1                             #   by this seed
  metrics = ["work", "furrow_depth"]   # to collect; default: all
  keep = ["surface", "picture"]        # of each point; default: neither
  golden = "before.h5"                 # run whose final surface each point's is compared with
  max_points = 10000                   # more are refused
  [set]                                # settings of every point (sandstroke info --scene-keys lists them)
  bed.cells = [500, 500]
  [axes]                               # what varies; the last one fastest
  relaxation.talus_angle = { from = 20, to = 45, step = 2.5 }
  force.k_s = { from = 100, to = 10000, count = 5, scale = "log" }
  force.k_f = { from = 1, to = 20 }    # latin: anything between
  model.preset = ["paper", "accurate"]
Metrics:
)" + lines;
}

SweepPlan load_plan(const fs::path& path) {
  expect_kind(path, {InputKind::plan});
  const TomlReader toml = TomlReader::from_file(path);
  SweepPlan plan;
  plan.file = path;
  toml.require("sweep.scene");
  plan.scene = path.parent_path() / toml.text("sweep.scene", "");
  check_readable(plan.scene);
  expect_kind(plan.scene, {InputKind::scene});
  plan.scene_text = read_text_file(plan.scene);
  for (const std::string& key : toml.keys_in("set"))
    plan.settings.push_back(key + "=" + toml.literal("set." + key));
  plan.design = read_design(toml, plan);
  plan.metrics = read_metrics(toml);
  for (const std::string& kept : toml.texts("sweep.keep", {})) {
    if (kept != "surface" && kept != "picture")
      toml.fail("sweep.keep", fmt::format("names '{}'; take from: surface, picture", kept));
    (kept == "surface" ? plan.keep_surface : plan.keep_picture) = true;
  }
  if (toml.has("sweep.golden")) {
    plan.golden = path.parent_path() / toml.text("sweep.golden", "");
    check_readable(plan.golden);
  }
  toml.reject_unread();
  check_values(toml, plan);
  return plan;
}

}  // namespace sandstroke
