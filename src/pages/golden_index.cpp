#include "pages/golden_index.h"

#include <algorithm>
#include <cmath>

#include "core/asset.h"
#include "io/png_file.h"
#include "picture/shrunk.h"
#include "report/data_uri.h"
#include "report/page.h"

SANDSTROKE_DECLARE_ASSET(golden_index);
SANDSTROKE_DECLARE_ASSET(parts_style);

namespace sandstroke {
namespace {

using Json = nlohmann::ordered_json;

constexpr int picture_width = 240;  // pixels

/// Where failed scenes come first, and then those that are nearest to a limit.
bool is_worse(const GoldenVerdict& a, const GoldenVerdict& b) {
  if (a.comparison.passed() != b.comparison.passed()) return !a.comparison.passed();
  return a.comparison.worst() > b.comparison.worst();
}

Json scene_json(const GoldenVerdict& scene) {
  const Comparison& comparison = scene.comparison;
  const double worst = comparison.worst();
  Json failed = Json::array();
  for (const Check& check : comparison.checks)
    if (!check.passed) failed.push_back({{"name", check.name}, {"sentence", check.sentence}});
  const bool drawn = scene.picture.width > 0;
  return {{"name", comparison.name},
          {"passed", comparison.passed()},
          {"checks", comparison.checks.size()},
          {"failed", std::move(failed)},
          {"worst", std::isfinite(worst) ? Json(worst) : Json()},
          {"seconds", comparison.seconds()},
          {"page", scene.page},
          {"picture",
           drawn ? Json(data_uri("image/png", encode_png(shrunk(scene.picture, picture_width)))) : Json()}};
}

}  // namespace

std::string golden_index(const std::vector<GoldenVerdict>& scenes) {
  std::vector<const GoldenVerdict*> sorted;
  for (const GoldenVerdict& scene : scenes) sorted.push_back(&scene);
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const GoldenVerdict* a, const GoldenVerdict* b) { return is_worse(*a, *b); });
  Json data{{"machine", describe_machine()}, {"scenes", Json::array()}};
  for (const GoldenVerdict* scene : sorted) data["scenes"].push_back(scene_json(*scene));
  return html_page("Golden check",
                   {.scripts = {SANDSTROKE_ASSET(golden_index)},
                    .styles = {SANDSTROKE_ASSET(parts_style)},
                    .charts = false},
                   data);
}

}  // namespace sandstroke
