#include "compare/run_checks.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "compare/field_difference.h"
#include "compare/image_difference.h"
#include "compare/trace_difference.h"
#include "core/error.h"
#include "core/stopwatch.h"

namespace sandstroke {
namespace {

// Ticks lie at whole multiples of the servo period, which is many times longer.
constexpr double time_limit = 1e-9;  // s
// Cell sizes come from the same division of the same settings; this allows for its rounding.
constexpr double cell_size_tolerance = 1e-12;  // relative

Check column_check(const std::string& name, const ColumnDifference& difference, double limit,
                   const std::string& unit) {
  const std::string where = fmt::format("at time {:.9g} s", difference.time);
  return limit_check(name, difference.max, limit, unit,
                     difference.max == 0.0 ? "the same in every tick"
                     : std::isnan(difference.max)
                         ? fmt::format("not a number {}", where)
                         : fmt::format("differs by {:.6g} {} {}; first differs at {:.9g} s", difference.max,
                                       unit, where, difference.first));
}

/// Checks that all positions are numbers. It does not compare them: the forces that follow from them are.
Check positions_check(const std::vector<TickRecord>& golden, const std::vector<TickRecord>& run) {
  for (const auto& [which, trace] : {std::pair("golden", &golden), {"the run", &run}})
    for (const TickRecord& tick : *trace)
      if (!tick.hand.position.allFinite() || !tick.device_position.allFinite())
        return failed_check("finite positions",
                            fmt::format("{}: not a number at time {:.9g} s", which, tick.time));
  return passed_check("finite positions", "all are numbers");
}

}  // namespace

Check complete_check(const std::string& which, const RunFile& run) {
  const bool complete = run.complete();
  return fact_check(
      which + " complete", complete,
      complete ? "ran to its end" : fmt::format("{}: was cut off before its end; run it again", run.name()));
}

Check frames_check(const RunFile& golden, const RunFile& run) {
  for (const RunFile* file : {&golden, &run}) {
    HeightField surface = file->initial_bed();
    const auto frames = static_cast<int>(file->frame_times().size());
    for (int k = 0; k < frames; ++k) file->apply_frame(k, surface);
  }
  return passed_check("frames", "all can be read");
}

Check height_check(const std::string& name, const HeightField& golden, const HeightField& run, double limit) {
  const bool same_size = cell_size_check(golden.cell_size(), run.cell_size()).passed;
  if (golden.rows() != run.rows() || golden.cols() != run.cols() || !same_size) {
    return failed_check(
        name, fmt::format("golden has {} x {} cells (x, y) of {} m, the run {} x {} of {} m, so the "
                          "cells do not match; compare runs of the same bed",
                          golden.cols(), golden.rows(), golden.cell_size(), run.cols(), run.rows(),
                          run.cell_size()));
  }
  const FieldDifference difference = field_difference(golden, run);
  if (difference.max == 0.0) return limit_check(name, 0.0, limit, "m", "the same in every cell");
  const std::string where = fmt::format("at row {}, col {} (x = {:.6g} m, y = {:.6g} m)", difference.row,
                                        difference.col, difference.x, difference.y);
  if (std::isnan(difference.max))
    return limit_check(name, difference.max, limit, "m", "not a number " + where);
  return limit_check(name, difference.max, limit, "m",
                     fmt::format("differs by {:.6g} m {}; RMS {:.6g} m, volume {:+.6g} m^3", difference.max,
                                 where, difference.rms, difference.volume));
}

std::vector<Check> floor_checks(const RunFile& golden, const RunFile& run, double limit) {
  const std::shared_ptr<const Ground> one = golden.ground(), other = run.ground();
  if (!one && !other) return {};
  if (!one || !other)
    return {
        failed_check("floor", fmt::format("{} has stones or another floor under its sand, but the other one "
                                          "has none; compare runs of the same bed",
                                          one ? "golden" : "the run"))};
  if (!one->floor.same_grid(other->floor))
    return {failed_check("floor", "is not compared, because the cells differ")};
  double most = 0.0;
  std::int64_t in_one = 0;
  visit_cells_of_both(one->floor, other->floor, [&](int, int, double a, double b) {
    if (std::isfinite(a) != std::isfinite(b))
      ++in_one;
    else if (a != b)
      most = std::max(most, std::abs(a - b));
  });
  if (in_one > 0)
    return {failed_check("floor", fmt::format("is under the sand in one of the runs only in {} of {} cells",
                                              in_one, std::int64_t{one->floor.rows()} * one->floor.cols()))};
  return {limit_check("floor", most, limit, "m",
                      most == 0.0 ? "the same in every cell" : fmt::format("differs by {:.6g} m", most))};
}

Check cell_size_check(double golden, double run) {
  return limit_check("cell size", std::abs(run - golden), cell_size_tolerance * golden, "m",
                     fmt::format("golden has cells of {} m, the run of {} m", golden, run));
}

std::vector<Check> trace_checks(const std::optional<std::vector<TickRecord>>& golden,
                                const std::optional<std::vector<TickRecord>>& run,
                                const Tolerances& tolerances) {
  if (!golden && !run) return {passed_check("trace", "neither has a trace")};
  if (!golden || !run) {
    return {failed_check(
        "trace", fmt::format("{} has no trace, but the other one has; set output.trace the same in both",
                             golden ? "the run" : "golden"))};
  }
  Check ticks = fact_check("ticks", golden->size() == run->size(),
                           fmt::format("golden has {} ticks, the run {}", golden->size(), run->size()));
  ticks.measured = static_cast<double>(run->size());
  ticks.limit = static_cast<double>(golden->size());

  const TraceDifference difference = trace_difference(*golden, *run);
  return {ticks,
          column_check("time", difference.time, time_limit, "s"),
          column_check("force", difference.force, tolerances.force, "N"),
          column_check("depth", difference.depth, tolerances.depth, "m"),
          column_check("level", difference.level, tolerances.depth, "m"),
          positions_check(*golden, *run)};
}

std::vector<Check> picture_checks(const Image& golden, const Image& run, const Tolerances& tolerances) {
  const ImageDifference difference = image_difference(golden, run, tolerances.pixel_above);
  return {limit_check("picture", difference.max, tolerances.pixel, "/255",
                      difference.max == 0 ? "the same in every pixel"
                                          : fmt::format("differs by {}/255 at pixel x = {}, y = {}",
                                                        difference.max, difference.x, difference.y)),
          limit_check("picture share", 100.0 * difference.fraction, 100.0 * tolerances.pixel_share, "%",
                      fmt::format("{:.4g} % of the pixels differ{}", 100.0 * difference.fraction,
                                  tolerances.pixel_above > 0.0
                                      ? fmt::format(" by more than {}/255", tolerances.pixel_above)
                                      : ""))};
}

void add_checks(std::vector<Check>& checks, const std::string& name,
                const std::function<std::vector<Check>()>& make) {
  const Stopwatch watch;
  Comparison made;
  try {
    made.checks = make();
  } catch (const Error& error) {
    if (is_of_the_machine(error)) throw;
    made.checks = {failed_check(name, error.what())};
  }
  if (!made.checks.empty()) made.checks.front().seconds += std::max(0.0, watch.seconds() - made.seconds());
  std::move(made.checks.begin(), made.checks.end(), std::back_inserter(checks));
}

}  // namespace sandstroke
