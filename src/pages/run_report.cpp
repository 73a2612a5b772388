#include "pages/run_report.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "compare/trace_difference.h"
#include "core/asset.h"
#include "core/error.h"
#include "pages/curves.h"
#include "pages/maps.h"
#include "pages/profiles.h"
#include "pages/sand_part.h"
#include "tool/tool_surface.h"

SANDSTROKE_DECLARE_ASSET(run);

namespace sandstroke {
namespace {

using Json = nlohmann::ordered_json;

/// Adds a figure, unless it is NaN.
void add_figure(Json& figures, const std::string& name, double value, const std::string& unit) {
  if (!std::isnan(value)) figures.push_back({{"name", name}, {"value", value}, {"unit", unit}});
}

Json figures_of(const std::vector<TickRecord>& trace, const std::optional<FurrowMeasures>& furrow) {
  const auto [force, depth] = trace_peaks(trace);
  Json figures = Json::array();
  add_figure(figures, "Stroke", trace.back().time - trace.front().time, "s");
  add_figure(figures, "Largest force", force, "N");
  add_figure(figures, "Largest depth", 1e3 * depth, "mm");
  add_figure(figures, "Energy into the sand", absorbed_energy(trace).back(), "J");
  if (furrow) {
    add_figure(figures, "Furrow depth", 1e3 * furrow->depth, "mm");
    add_figure(figures, "Depth that the hand wanted", 1e3 * furrow->asked_depth, "mm");
  }
  return figures;
}

Json error_part(const std::optional<ErrorEstimate>& error) {
  Json figures = Json::array();
  std::string text =
      "This run has no error estimate. sandstroke run --estimate-error estimates how far a run is from one "
      "with infinitely small steps.";
  if (error) {
    text = error->at_rest ? "The estimated difference from a run with infinitely small steps."
                          : "The sand was not at rest, so this estimate says little.";
    add_figure(figures, "Part of the changed sand that lies elsewhere", 100.0 * error->height_share, "%");
    add_figure(figures, "Height, root mean square over the changed cells", 1e3 * error->height_rms, "mm");
    add_figure(figures, "Height, largest", 1e3 * error->height_max, "mm");
    add_figure(figures, "Force, root mean square", error->force_rms, "N");
    add_figure(figures, "Force, largest", error->force_max, "N");
  }
  return {{"kind", "figures"}, {"title", "Error estimate"}, {"text", text}, {"figures", figures}};
}

/// The initial surface, frames evenly spread over time, and the last one.
Json sand_part(const RunFile& run, const LastSurface& last) {
  constexpr std::size_t most_frames = 60;
  const HeightField initial = run.initial_bed();
  SandPart part("The sand in 3-D", "The bed at the start, while the tool moved through it, and at the end.",
                initial);
  part.add("initial surface", initial);
  const std::vector<double> times = run.frame_times();
  const std::size_t shown = std::min(times.size(), most_frames);
  RunFrames frames(run);
  for (std::size_t i = 0; i < shown; ++i) {
    const std::size_t k = i * times.size() / shown;
    if (times[k] > 0.0) part.add(fmt::format("{:.3g} s", times[k]), frames.surface(static_cast<int>(k)));
  }
  part.add(last.name, last.surface);
  return part.json();
}

/// Adds the parts that need the trace: curves, figures, profiles.
void add_stroke(PageOfParts& page, const RunFile& run, const LastSurface& last) {
  Scene scene;
  std::vector<TickRecord> trace;
  page.add_part("The stroke", [&] {
    scene = run.scene();
    if (!scene.stroke)
      throw_input_error("{}: the scene has no stroke; the bed only came to rest", run.name());
    if (!run.has_trace())
      throw_input_error("{}: holds no trace of the stroke; run the scene with output.trace = true",
                        run.name());
    trace = run.trace();
    if (trace.empty()) throw_input_error("{}: was cut off before its first tick", run.name());
    return traces_part(trace);
  });
  if (trace.empty()) return;
  const HeightField initial = run.initial_bed();
  TipPathGatherer gatherer(scene);
  for (const TickRecord& tick : trace) gatherer.on_tick(tick);
  page.data["figures"] = figures_of(trace, gatherer.furrow(initial, last.surface));
  page.add_part("A profile of the sand", [&] {
    if (gatherer.path().points.empty()) throw_input_error("{}: the tool never touched the sand", run.name());
    return profiles_part(gatherer.path(), tool_reach(scene.tool), initial, last);
  });
}

}  // namespace

PageOfParts run_report(const RunFile& run, const std::function<Image(const LastSurface&)>& draw,
                       const std::optional<ErrorEstimate>& error) {
  const std::filesystem::path file = run.name();
  PageOfParts page{SANDSTROKE_ASSET(run), file.filename().string(), {}};
  page.data = {{"figures", Json::array()},
               {"parts", Json::array()},
               {"missing", Json::array()},
               {"scene", as_far_as_known([&] { return run.scene_text(); })},
               {"provenance", Json::array()}};
  for (const auto& [entry, value] : as_far_as_known([&] { return run.provenance(); }))
    page.data["provenance"].push_back({entry, value});
  const LastSurface last = last_surface(run);
  if (!run.complete())
    page.data["missing"].push_back(
        {{"name", "The end of the run"},
         {"sentence", fmt::format("{}: was cut off; the page shows its {}", run.name(), last.name)}});
  page.add_part("The picture", [&] { return picture_part(draw(last), last.name); });
  page.add_part("The sand in 3-D", [&] { return sand_part(run, last); });
  add_stroke(page, run, last);
  page.data["parts"].push_back(error_part(error));
  page.add_part("The error's map", [&]() -> Json {
    const std::optional<HeightField> map = run.error_map();
    return map ? error_map_part(*map) : Json();
  });
  return page;
}

}  // namespace sandstroke
