#include "sweep/collected_sweep.h"

#include <cmath>
#include <map>

#include "core/counted.h"
#include "core/error.h"
#include "core/hash.h"

namespace sandstroke {
namespace {

/// Reads the surfaces of the points that have results.
void read_surfaces(CollectedSweep& sweep, CollectReport& report) {
  std::string first_missing;
  const KeptSurface* first = nullptr;
  bool alike = true;
  std::map<std::filesystem::path, KeptSurface> known;  // points may share one
  for (std::size_t point = 0; point < sweep.results.size(); ++point) {
    if (!sweep.results[point] || failed(sweep.results[point]->verdict)) continue;
    try {
      const std::filesystem::path file = sweep.folder.surface_file(point);
      auto at = known.find(file);
      if (at == known.end()) at = known.emplace(file, inspect_surface(file)).first;
      sweep.surfaces[point] = at->second;
    } catch (const Error& failure) {
      if (is_of_the_machine(failure)) throw;
      if (report.surfaces_missing++ == 0) first_missing = failure.what();
      continue;
    }
    if (!first) first = &*sweep.surfaces[point];
    alike = alike && first->bed.same_grid(sweep.surfaces[point]->bed);
  }
  if (report.surfaces_missing > 0)
    report.sentences.push_back(
        fmt::format("{} missing; remove the files of these points and run the sweep again. The first: {}",
                    counted(report.surfaces_missing, "surface"), first_missing));
  if (first && alike) sweep.bed = first->bed;
  if (!alike)
    report.sentences.push_back(
        "the points' beds differ in cells or size, so their surfaces are not joined: they are in points/ "
        "only");
}

}  // namespace

CollectedSweep::CollectedSweep(const SweepFolder& of, CollectReport& report)
    : folder(of), results(of.points()), unreadable(of.points()), surfaces(of.points()) {
  std::string first_unreadable, first_failed;
  for (std::size_t point = 0; point < results.size(); ++point) {
    results[point] = folder.read(point);
    if (!results[point]) {
      unreadable[point] = std::filesystem::exists(folder.point_file(point));
      if (unreadable[point] && report.unreadable == 0) first_unreadable = folder.point_file(point).string();
      ++(unreadable[point] ? report.unreadable : report.missing);
    } else if (failed(results[point]->verdict)) {
      if (report.failed++ == 0) first_failed = fmt::format("point {}: {}", point, results[point]->reason);
    } else {
      ++report.done;
    }
  }
  if (report.missing > 0)
    report.sentences.push_back(
        fmt::format("{} missing; sweep again to run the rest", counted(report.missing, "point")));
  if (report.unreadable > 0)
    report.sentences.push_back(
        fmt::format("{} cut off or damaged, the first in {}; sweep again to run the rest",
                    counted(report.unreadable, "point"), first_unreadable));
  if (report.failed > 0)
    report.sentences.push_back(fmt::format("{} point{} failed; the first is {}", report.failed,
                                           report.failed == 1 ? "" : "s", first_failed));
  if (folder.manifest().keep_surface) read_surfaces(*this, report);
  report.content_hash = content_hash(*this);
}

double CollectedSweep::metric(std::size_t point, std::size_t metric) const {
  return results[point] ? results[point]->metrics[metric] : PointResult::none;
}

std::string CollectedSweep::reason(std::size_t point) const {
  if (unreadable[point]) return "its file is cut off or damaged";
  return results[point] ? results[point]->reason : "";
}

std::size_t CollectedSweep::verdict(std::size_t point) const {
  return results[point] ? static_cast<std::size_t>(results[point]->verdict) : verdict_names.size();
}

const std::string& CollectedSweep::verdict_name(std::size_t point) const {
  return results[point] ? verdict_names[verdict(point)] : missing_verdict;
}

std::string content_hash(const CollectedSweep& sweep) {
  ContentHash hash;
  const auto add = [&](const std::string& text) { hash.add(text.c_str(), text.size() + 1); };
  const SweepDesign& design = sweep.folder.design();
  add(design.grid ? "grid" : "latin");
  for (const SweepAxis& axis : design.axes) {
    add(axis.key);
    add(std::to_string(axis.values.size()));
    for (const std::string& value : axis.values) add(value);
  }
  const std::vector<Metric>& metrics = sweep.folder.metrics();
  for (const Metric& metric : metrics) add(metric.name);
  for (std::size_t point = 0; point < sweep.results.size(); ++point) {
    add(sweep.verdict_name(point));
    if (!sweep.results[point]) continue;
    for (std::size_t i = 0; i < metrics.size(); ++i) {
      if (metrics[i].timing) continue;
      // NaNs may differ in their bits.
      const double value = sweep.metric(point, i), number = std::isnan(value) ? PointResult::none : value;
      hash.add(&number, sizeof number);
    }
    add(sweep.surfaces[point] ? sweep.surfaces[point]->hash : "");
  }
  return hash.text();
}

}  // namespace sandstroke
