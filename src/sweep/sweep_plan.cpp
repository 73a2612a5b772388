#include "sweep/sweep_plan.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>

#include "core/error.h"
#include "core/input_file.h"
#include "io/input_kind.h"
#include "io/key_reader.h"
#include "io/scene_keys.h"
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

/// A scene that was tried, and what it leaves out.
struct TriedScene {
  SceneFile scene;
  std::vector<LeftOut> left_out;

  bool uses(const std::string& key) const {
    return std::none_of(left_out.begin(), left_out.end(), [&](const LeftOut& one) { return one.key == key; });
  }
};

/// Tries a scene. An error names the plan's key that gave the wrong setting.
TriedScene try_scene(const TomlReader& toml, const SweepPlan& plan, const std::vector<std::string>& settings,
                     const std::string& tried_key) {
  try {
    TriedScene tried;
    tried.scene = plan.scene_with(settings, tried.left_out);
    return tried;
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

/// Checks the values of a plan's axes. The settings of the first point come first, then those of others.
class AxesCheck {
 public:
  AxesCheck(const TomlReader& toml, SweepPlan& plan) : toml_(toml), plan_(plan), firsts_(plan.settings) {
    for (const std::string& setting : plan.design.settings(0)) firsts_.push_back(setting);
    first_ = try_scene(toml, plan, firsts_, fails_without_axes(plan) ? "" : "axes");
  }

  /// Each value of each axis, and whether each setting applies somewhere.
  void check_all() {
    std::vector<LeftOut> everywhere, at_first;  // by no axis, or by a preset that is one
    for (const LeftOut& one : first_.left_out)
      if (!axis_of(kind_of(one))) (where_used(one.key) ? at_first : everywhere).push_back(one);
    note("every point", everywhere);
    note("the first point", at_first);
    for (std::size_t i = 0; i < plan_.design.axes.size(); ++i) check_axis(i);
    for (const std::string& setting : plan_.settings)
      if (const std::string key = setting.substr(0, setting.find('=')); !first_.uses(key))
        check_applies("set.", setting, key);
  }

 private:
  const SweepAxis* axis_of(const std::string& key) const {
    for (const SweepAxis& axis : plan_.design.axes)
      if (axis.key == key) return &axis;
    return nullptr;
  }

  /// The settings of the first point, but for the value of one axis.
  std::vector<std::string> with(std::size_t axis, std::size_t value,
                                std::vector<std::string> settings) const {
    const SweepAxis& changed = plan_.design.axes[axis];
    settings[plan_.settings.size() + axis] = changed.key + "=" + changed.values[value];
    return settings;
  }

  /// Settings with which a key applies: the first point's, or with another value of the axis that decides it.
  std::optional<std::vector<std::string>> where_used(const std::string& key) const {
    if (first_.uses(key)) return firsts_;
    for (std::size_t i = 0; i < plan_.design.axes.size(); ++i) {
      if (!decides(plan_.design.axes[i].key, key)) continue;
      for (std::size_t value = 1; value < plan_.design.axes[i].values.size(); ++value) {
        std::vector<std::string> settings = with(i, value, firsts_);
        if (try_scene(toml_, plan_, settings, "axes." + plan_.design.axes[i].key).uses(key)) return settings;
      }
    }
    return std::nullopt;
  }

  /// True if the kind, or a preset of kinds, decides in the first point that the key does not apply.
  bool decides(const std::string& kind, const std::string& key) const {
    for (const LeftOut& one : first_.left_out)
      if (one.key == key) return kind_of(one) == kind || kind.ends_with("preset");
    return false;
  }

  /// "tool.shape" of "tool.shape is plate".
  static std::string kind_of(const LeftOut& one) {
    return one.condition.substr(0, one.condition.find(" is "));
  }

  void note(const std::string& points, const std::vector<LeftOut>& left_out) {
    if (!left_out.empty()) plan_.notes.push_back(points + ": " + left_out_text(left_out));
  }

  void check_applies(const std::string& table, const std::string& setting, const std::string& key) const {
    if (where_used(key)) return;
    for (const LeftOut& one : first_.left_out)
      if (one.key == key)
        toml_.fail(table + key, fmt::format("cannot be {}: {} applies only where {}; remove it, or change "
                                            "that setting",
                                            setting.substr(key.size() + 1), key, one.condition));
  }

  void check_axis(std::size_t i) {
    SweepAxis& axis = plan_.design.axes[i];
    check_applies("axes.", axis.key + "=" + axis.values.front(), axis.key);
    const std::vector<std::string> used = *where_used(axis.key);
    const std::string tried_key = axis.key == stroke_key ? "sweep.strokes" : "axes." + axis.key;
    axis.unit = setting_unit(try_scene(toml_, plan_, used, tried_key).scene, axis.key);
    std::vector<LeftOut> at_first;
    for (const LeftOut& one : first_.left_out)
      if (kind_of(one) == axis.key) at_first.push_back(one);
    note(axis.key + " = " + axis.label(0), at_first);
    constexpr std::size_t most_of_range = 100;  // what holds for these holds between them
    const std::size_t values = axis.values.size();
    for (const std::size_t value : spread_indices(values, axis.of_range ? most_of_range : values)) {
      if (value == 0 && used == firsts_) continue;
      const TriedScene tried = try_scene(toml_, plan_, with(i, value, used), tried_key);
      if (used != firsts_) continue;  // that of another axis is noted there
      std::vector<LeftOut> more;
      for (const LeftOut& one : tried.left_out)
        if (kind_of(one) == axis.key || (first_.uses(one.key) && !axis_of(kind_of(one)))) more.push_back(one);
      note(axis.key + " = " + axis.label(value), more);
    }
  }

  const TomlReader& toml_;
  SweepPlan& plan_;
  std::vector<std::string> firsts_;
  TriedScene first_;
};

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
  AxesCheck(toml, plan).check_all();
}

}  // namespace

SceneFile SweepPlan::scene_with(const std::vector<std::string>& all_settings) const {
  std::vector<LeftOut> left_out;
  return scene_with(all_settings, left_out);
}

SceneFile SweepPlan::scene_with(const std::vector<std::string>& all_settings,
                                std::vector<LeftOut>& left_out) const {
  SceneFile made = combined_scene({scene_text, scene.string()}, all_settings, left_out);
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
