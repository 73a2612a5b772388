#include "sweep/plan_keys.h"

#include <spdlog/fmt/fmt.h>

#include <limits>

#include "sweep/metrics.h"

namespace sandstroke {

void show_plan(KeyVisitor& v, PlanKeys& keys) {
  v.section("sweep", "the scene of all points, and the results to keep; files are relative to the plan");
  v.require("scene");
  v.text("scene", keys.scene, "scene that every point starts from");
  v.texts("strokes", keys.strokes, "strokes (files) instead of the scene's; they are the first axis");
  v.integers("max_points", &keys.max_points, 1, 1, most_points, "largest number of points");
  int design = keys.grid ? 0 : 1;
  v.choice("design", design, {"grid", "latin"}, "every combination, or a Latin hypercube");
  keys.grid = design == 0;
  if (!keys.grid) {
    v.require("samples");
    v.integers("samples", &keys.samples, 1, 1, keys.max_points,
               "points of the hypercube, at most max_points");
    v.integers("seed", &keys.seed, 1, 0, std::numeric_limits<int>::max(), "seed of the hypercube");
  }
  std::vector<std::string> metrics;
  for (const Metric& metric : all_metrics()) metrics.push_back(metric.name);
  v.texts(
      "metrics", keys.metrics,
      fmt::format("metrics to collect; default: all of {} (golden_*: where golden is given, error_*: with "
                  "estimate_error); sandstroke help metrics defines them",
                  fmt::join(metrics, ", "))
          .c_str());
  v.texts("keep", keys.keep, "results to keep from each point: surface, picture; default: neither");
  v.choice("estimate_error", keys.second, {"none", "coarser", "finer"},
           "estimate each point's error by a second run, as run --estimate-error does");
  v.given("golden");
  v.text("golden", keys.golden,
         "run file; the final surface of each point is compared with its final surface");
}

void show_range(KeyVisitor& v, const std::string& name, RangeKeys& keys, int most_values) {
  v.section(name.c_str(), "a range of values, such as { from = 20, to = 45, step = 2.5 }");
  for (auto [end, value] : {std::pair{"from", &keys.from}, std::pair{"to", &keys.to}}) {
    v.require(end);
    v.number(end, *value, any_number, "", end == std::string("from") ? "first value" : "last value");
  }
  int scale = keys.logarithmic ? 1 : 0;
  v.choice("scale", scale, {"linear", "log"}, "how the values are spread");
  keys.logarithmic = scale == 1;
  if (v.given("count"))
    v.integers("count", &keys.count.emplace(1), 1, 1, most_values,
               "number of values, at most sweep.max_points");
  if (v.given("step"))
    v.number("step", keys.step.emplace(1.0), any_number, "",
             "distance between values, instead of count. Without count and step, a Latin hypercube takes any "
             "value of the range");
}

std::vector<KeySection> all_plan_keys() {
  return all_keys([](KeyVisitor& visitor) {
    PlanKeys plan;
    RangeKeys range;
    show_plan(visitor, plan);
    visitor.section("set", "settings of every point: keys of scenes, such as bed.cells = [500, 500]");
    visitor.section(
        "axes",
        "the settings to vary (the last one varies fastest): keys of scenes, each with a list of "
        "values, such as model.preset = [\"paper\", \"accurate\"], or a range. What does not apply at a "
        "point, as tool.width with tool.shape = \"sphere\", is left out there");
    show_range(visitor, "axes.KEY", range, plan.max_points);
  });
}

}  // namespace sandstroke
