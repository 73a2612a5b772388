#include "sweep/sweep_plan.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>

#include "core/error.h"
#include "core/input_file.h"
#include "io/input_kind.h"
#include "io/key_reader.h"
#include "io/scene_keys.h"
#include "io/scene_toml.h"
#include "sweep/metrics.h"
#include "sweep/plan_axes.h"
#include "sweep/plan_keys.h"

namespace sandstroke {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> read_metrics(const TomlReader& toml, const PlanKeys& keys) {
  std::vector<std::string> known;  // without those that lack a golden surface or an error estimate
  const bool golden = toml.has("sweep.golden"), error = keys.second != 0;
  for (const Metric& metric : all_metrics())
    if ((golden || metric.needs != Metric::golden) && (error || metric.needs != Metric::error))
      known.push_back(metric.name);
  if (!toml.has("sweep.metrics")) return known;
  const std::vector<std::string>& metrics = keys.metrics;
  if (metrics.empty()) toml.fail("sweep.metrics", "is empty; name one or remove it");
  for (const std::string& metric : metrics) {
    if (std::find(known.begin(), known.end(), metric) == known.end())
      toml.fail(
          "sweep.metrics",
          fmt::format("names '{}'; take from: {}{}{}", metric, fmt::join(known, ", "),
                      golden ? "" : " (and with sweep.golden the golden_* metrics)",
                      error ? "" : " (and with sweep.estimate_error the error_* metrics)") +
              (metric == "slope_max" ? "; slope_max is now slope_max_geometric, beside slope_max_law" : ""));
    if (std::count(metrics.begin(), metrics.end(), metric) > 1)
      toml.fail("sweep.metrics", fmt::format("names '{}' twice; name it once", metric));
  }
  return metrics;
}

/// Tries a scene. An error names the plan's key that gave the wrong setting.
SceneFile try_scene(const TomlReader& toml, const SweepPlan& plan, const std::vector<std::string>& settings,
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
    toml.fail(tried_key, "gives a scene that is not valid: " + sentence);
  }
}

/// True if the plan's scene fails even without its axes.
bool fails_without_axes(const SweepPlan& plan) {
  try {
    plan.scene_with(plan.settings);
    return false;
  } catch (const Error&) {
    return true;
  }
}

/// Checks each value of each axis, together with the first values of the others.
void check_values(const TomlReader& toml, SweepPlan& plan) {
  std::vector<std::string> firsts = plan.settings;
  for (const std::string& setting : plan.design.settings(0)) firsts.push_back(setting);
  const SceneFile scene = try_scene(toml, plan, firsts, fails_without_axes(plan) ? "" : "axes");
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

/// Fills in a plan from its scene and its keys.
void fill_plan(const TomlReader& toml, const PlanKeys& keys, SweepPlan& plan) {
  for (const std::string& key : toml.keys_in("set"))
    plan.settings.push_back(key + "=" + toml.literal("set." + key));
  plan.design = read_design(toml, keys, plan);
  plan.metrics = read_metrics(toml, keys);
  if (keys.second != 0) plan.second = static_cast<SecondSolution>(keys.second - 1);
  for (const std::string& kept : keys.keep) {
    if (kept != "surface" && kept != "picture")
      toml.fail("sweep.keep", fmt::format("names '{}'; take from: surface, picture", kept));
    if (kept == "surface")
      plan.keep_surface = true;
    else
      plan.keep_picture = true;
  }
  if (toml.has("sweep.golden")) {
    plan.golden = plan.file.parent_path() / keys.golden;
    check_readable(plan.golden);
  }
  toml.reject_unread([] { return conditions(all_plan_keys()); });
  check_values(toml, plan);
}

}  // namespace

SceneFile SweepPlan::scene_with(const std::vector<std::string>& all_settings) const {
  SceneFile made = scene_from_text(scene_text, scene.string(), all_settings);
  if (second) second_scene(made, *second);  // throws here if there is no second solution
  return made;
}

SceneFile SweepPlan::scene_of(std::size_t point) const {
  std::vector<std::string> all = settings;
  for (const std::string& setting : design.settings(point)) all.push_back(setting);
  return scene_with(all);
}

SweepPlan load_plan(const fs::path& path) {
  return read_as({InputKind::plan}, path, [&] {
    const TomlReader toml = TomlReader::from_file(path);
    SweepPlan plan;
    plan.file = path;
    PlanKeys keys;
    read_keys(toml, [&](KeyVisitor& visitor) { show_plan(visitor, keys); });
    plan.scene = path.parent_path() / keys.scene;
    check_readable(plan.scene);
    plan.scene_text = read_text_file(plan.scene);
    read_as({InputKind::scene}, plan.scene, [&] { fill_plan(toml, keys, plan); });
    return plan;
  });
}

}  // namespace sandstroke
