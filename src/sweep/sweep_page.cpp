#include "sweep/sweep_page.h"

#include <algorithm>
#include <map>

#include "core/asset.h"
#include "core/counted.h"
#include "core/error.h"
#include "io/png_file.h"
#include "io/table.h"
#include "picture/shrunk.h"
#include "report/data_uri.h"
#include "report/page.h"
#include "sweep/effects.h"
#include "sweep/thumbnail.h"

SANDSTROKE_DECLARE_ASSET(sweep);
SANDSTROKE_DECLARE_ASSET(sweep_charts);
SANDSTROKE_DECLARE_ASSET(sweep_effects);
SANDSTROKE_DECLARE_ASSET(sweep_points);
SANDSTROKE_DECLARE_ASSET(sweep_style);

namespace sandstroke {
namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

/// An axis's values on the page. Each text is listed once, even if points of a Latin hypercube share it.
struct PageAxis {
  PageAxis(const SweepAxis& axis, bool join_texts) {
    const bool numeric = axis.numeric();
    std::map<std::string, std::size_t> seen;
    for (std::size_t i = 0; i < axis.values.size(); ++i) {
      const auto [text, is_new] = seen.try_emplace(axis.label(i), values.size());
      if (join_texts && !numeric && !is_new) {
        index.push_back(text->second);
        continue;
      }
      index.push_back(values.size());
      values.push_back(numeric ? Json(axis.number(i)) : Json(axis.label(i)));
    }
    json = {{"name", axis.key},
            {"unit", axis.unit},
            {"log", axis.logarithmic},
            {"numeric", numeric},
            {"values", values}};
  }

  Json values = Json::array(), json;
  std::vector<std::size_t> index;  // index of each of the axis's values in `values`
};

std::vector<PageAxis> page_axes(const SweepDesign& design) {
  // The page tells points apart by their positions on the axes.
  const bool join_texts = std::any_of(design.axes.begin(), design.axes.end(),
                                      [](const SweepAxis& axis) { return axis.numeric(); });
  std::vector<PageAxis> axes;
  for (const SweepAxis& axis : design.axes) axes.emplace_back(axis, join_texts);
  return axes;
}

/// Makes pictures of points as data URIs. null: there is none.
class Thumbnails {
 public:
  explicit Thumbnails(const CollectedSweep& sweep) : sweep_(sweep) {
    for (const std::optional<KeptSurface>& surface : sweep.surfaces)
      if (surface) span_ = std::max(span_, surface->highest);
    if (span_ == 0.0) span_ = 1.0;  // all sand at 0
  }

  /// The point's picture, if kept; otherwise a map of its surface. All maps have the same scale.
  Json of(std::size_t point) {
    if (!sweep_.results[point] || failed(sweep_.results[point]->verdict)) return nullptr;
    const SweepFolder& folder = sweep_.folder;
    try {
      if (folder.manifest().keep_picture)
        return uri(shrunk(read_png(folder.picture_file(point)), thumbnail_width));
    } catch (const Error& failure) {
      if (is_of_the_machine(failure) && std::filesystem::exists(folder.picture_file(point))) throw;
      if (pictures_missing_++ == 0) first_missing_ = failure.what();
    }
    if (!sweep_.surfaces[point]) return nullptr;
    return uri(surface_thumbnail(sweep_.surfaces[point]->file, span_));
  }

  void report_missing(CollectReport& report) const {
    if (pictures_missing_ > 0)
      report.sentences.push_back(
          fmt::format("{} missing; remove the files of these points and run the sweep again. The first: {}",
                      counted(pictures_missing_, "picture"), first_missing_));
  }

 private:
  static Json uri(const Image& image) { return data_uri("image/png", encode_png(image)); }

  const CollectedSweep& sweep_;
  double span_ = 0.0;  // m
  std::size_t pictures_missing_ = 0;
  std::string first_missing_;
};

Json points_json(const CollectedSweep& sweep, const std::vector<PageAxis>& axes, CollectReport& report) {
  const SweepDesign& design = sweep.folder.design();
  const SweepManifest& manifest = sweep.folder.manifest();
  const bool kept = manifest.keep_picture || manifest.keep_surface;
  const bool thumbnails_fit = sweep.results.size() <= most_thumbnails;
  if (kept && !thumbnails_fit)
    report.sentences.push_back(fmt::format(
        "the page shows no pictures: there are more than {} points. They are in points/", most_thumbnails));
  Thumbnails thumbnails(sweep);
  Json points = Json::array();
  for (std::size_t point = 0; point < sweep.results.size(); ++point) {
    Json at = Json::array(), metrics = Json::array();
    for (std::size_t axis = 0; axis < design.axes.size(); ++axis)
      at.push_back(axes[axis].index[design.value_at(point, axis)]);
    for (std::size_t metric = 0; metric < sweep.folder.metrics().size(); ++metric)
      metrics.push_back(number_or_null(sweep.metric(point, metric)));
    points.push_back({{"point", point},
                      {"at", std::move(at)},
                      {"verdict", sweep.verdict_name(point)},
                      {"reason", sweep.reason(point)},
                      {"metrics", std::move(metrics)},
                      {"thumbnail", kept && thumbnails_fit ? thumbnails.of(point) : Json()},
                      {"command", sweep.folder.command(point)}});
  }
  thumbnails.report_missing(report);
  return points;
}

/// For each metric its effects, the largest first. axes: indices.
Json effects_json(const CollectedSweep& sweep) {
  Json all = Json::array();
  for (std::size_t metric = 0; metric < sweep.folder.metrics().size(); ++metric) {
    Json effects = Json::array();
    for (const Effect& one : effects_on(sweep, metric))
      effects.push_back(
          {{"axes", one.axes}, {"share", one.share}, {"least", one.least}, {"greatest", one.greatest}});
    all.push_back(std::move(effects));
  }
  return all;
}

}  // namespace

Json sweep_page_data(const CollectedSweep& sweep, CollectReport& report) {
  Json metrics = Json::array();
  for (const Metric& metric : sweep.folder.metrics())
    metrics.push_back({{"name", metric.name},
                       {"title", metric.title},
                       {"unit", metric.unit},
                       {"definition", metric.definition}});
  const std::vector<PageAxis> axes = page_axes(sweep.folder.design());
  Json axes_json = Json::array();
  for (const PageAxis& axis : axes) axes_json.push_back(axis.json);
  // Takes the folder's name from a file in it: the folder may be given as "." or end in a slash.
  const fs::path file = fs::absolute(sweep.folder.point_file(0)).lexically_normal();
  return {{"title", file.parent_path().parent_path().filename().string()},
          {"machine", describe_machine()},
          {"scene", sweep.folder.manifest().scene},
          {"design", sweep.folder.design().grid ? "grid" : "latin"},
          {"axes", std::move(axes_json)},
          {"metrics", std::move(metrics)},
          {"effects", effects_json(sweep)},
          {"idle", idle_axes(sweep)},
          {"points", points_json(sweep, axes, report)},
          {"counts",
           {{"points", sweep.results.size()},
            {"done", report.done},
            {"failed", report.failed},
            {"missing", report.missing + report.unreadable}}}};
}

std::string sweep_page(const Json& data) {
  const PageAssets own{.scripts = {SANDSTROKE_ASSET(sweep_charts), SANDSTROKE_ASSET(sweep_effects),
                                   SANDSTROKE_ASSET(sweep_points), SANDSTROKE_ASSET(sweep)},
                       .styles = {SANDSTROKE_ASSET(sweep_style)}};
  return html_page("Sweep " + data["title"].get<std::string>(), own, data);
}

}  // namespace sandstroke
