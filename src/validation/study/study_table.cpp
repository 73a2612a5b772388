#include "validation/study/study_table.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>

#include "core/asset.h"
#include "core/error.h"
#include "report/page.h"
#include "validation/study/advice.h"
#include "validation/study/study_summary.h"
#include "validation/study/surface_error.h"

SANDSTROKE_DECLARE_ASSET(bench);
SANDSTROKE_DECLARE_ASSET(bench_advice);

namespace sandstroke {
namespace {

struct Column {
  const char *name, *title, *unit;
  std::variant<double (*)(const StudyRun&), std::string (*)(const StudyRun&)> value;
};

#define TEXT(expression) +[](const StudyRun& run) -> std::string { return expression; }
#define NUMBER(expression) +[](const StudyRun& run) -> double { return expression; }

const std::vector<Column> columns = {
    {"problem", "Problem", "", TEXT(run.problem)},
    {"series", "Series", "", TEXT(run.series)},
    {"label", "Settings", "", TEXT(run.label)},
    {"law", "Law", "", TEXT(run.settings.law)},
    {"method", "Method", "", TEXT(run.settings.method)},
    {"cells", "Cells along x", "", NUMBER(run.settings.cells)},
    {"cell_size", "Cell size", "m", NUMBER(run.settings.cell_size)},
    {"tolerance", "Tolerance", "", NUMBER(run.settings.tolerance)},
    {"step_tolerance", "Step tolerance", "", NUMBER(run.settings.step_tolerance)},
    {"share", "Fraction of the excess moved per pass (c)", "", NUMBER(run.settings.share)},
    {"servo_rate", "Servo rate", "Hz", NUMBER(run.settings.servo_rate)},
    {"relaxation_rate", "Relaxation rate", "Hz", NUMBER(run.settings.relaxation_rate)},
    {"tool", "Tool", "", TEXT(run.settings.tool)},
    {"force_law", "Force law", "", TEXT(run.settings.force_law)},
    {"threads", "Threads", "", NUMBER(run.settings.threads)},
    {"wall_seconds", "Time", "s", NUMBER(run.wall_seconds)},
    {"wall_median", "Median time", "s", NUMBER(run.median_seconds)},
    {"wall_largest", "Largest time", "s", NUMBER(run.largest_seconds)},
    {"repeats", "Repeats", "", NUMBER(run.repeats)},
    {"disturbed", "Disturbed by other programs", "", NUMBER(run.disturbed)},
    {"passes", "Passes", "", NUMBER(run.score.passes)},
    {"cells_visited", "Cells visited", "", NUMBER(run.score.cells_visited)},
    {"l1", "Misplaced sand, fraction of the moved sand", "", NUMBER(run.score.l1)},
    {"rms_height", "Height error, rms", "m", NUMBER(run.score.rms_height)},
    {"largest_height", "Height error, largest", "m", NUMBER(run.score.largest_height)},
    {"rms_relative", "Height error, rms of the shape's height", "", NUMBER(run.score.rms_relative)},
    {"largest_relative", "Height error, largest of the shape's height", "",
     NUMBER(run.score.largest_relative)},
    {"slope_error_largest", "Slope error, largest of all directions", "deg", NUMBER(run.score.slope_error)},
    {"volume_error", "Sand that stays, relative error", "", NUMBER(run.score.volume_error)},
    {"cut_error", "Height of a cut, relative error", "", NUMBER(run.score.cut_error)},
    {"work_error", "Work error, relative", "", NUMBER(run.score.work_error)},
    {"force_error", "Force error, rms of the largest", "", NUMBER(run.score.force_error)},
    {"position_error", "Position error, rms", "m", NUMBER(run.score.position_error)},
    {"volume_drift", "Volume drift, of the moved", "", NUMBER(run.score.volume_drift)},
    {"displaced_volume", "Sand pushed", "m^3", NUMBER(run.score.displaced_volume)},
    {"furrow_depth", "Furrow", "m", NUMBER(run.score.furrow_depth)},
    {"tick_microseconds", "Time of a tick", "us", NUMBER(1e6 * run.wall_seconds / run.score.timed_ticks)},
    {"of_paper", "Time of a tick, over the paper's law", "", NUMBER(run.of_paper)},
    {"converged", "At rest", "", NUMBER(run.score.converged)},
    {"pareto", "On the Pareto front", "", NUMBER(run.pareto)},
};
#undef TEXT
#undef NUMBER

}  // namespace

double number_in(const std::string& column, const StudyRun& run) {
  for (const Column& one : columns)
    if (one.name == column) return std::get<double (*)(const StudyRun&)>(one.value)(run);
  throw_input_error("a run of the study has no column '{}'", column);
}

Table runs_table(const std::vector<StudyRun>& runs) {
  Table table;
  for (const Column& column : columns)
    std::visit(
        [&](auto value) {
          std::vector<decltype(value(runs.front()))> values;
          for (const StudyRun& run : runs) values.push_back(value(run));
          table.columns.push_back({column.name, column.title, column.unit, std::move(values)});
        },
        column.value);
  return table;
}

Table orders_table(const std::vector<ConvergenceOrder>& orders) {
  std::vector<std::string> problems, series, errors;
  std::vector<double> order, low, high, points;
  for (const ConvergenceOrder& one : orders) {
    problems.push_back(one.problem);
    series.push_back(one.series);
    errors.push_back(one.error);
    order.push_back(one.order);
    low.push_back(one.low);
    high.push_back(one.high);
    points.push_back(one.points);
  }
  return {{{"problem", "Problem", "", problems},
           {"series", "Series", "", series},
           {"error", "Error", "", errors},
           {"order", "Order", "", order},
           {"low", "95 % from", "", low},
           {"high", "to", "", high},
           {"points", "Points", "", points}}};
}

namespace {

using Json = nlohmann::ordered_json;

Json plot_json(const Plot& plot) {
  const auto look_name = [](Plot::Look look) {
    return look == Plot::Look::line ? "line" : look == Plot::Look::dashed ? "dashed" : "points";
  };
  Json json{{"title", plot.title},   {"note", plot.note},       {"x_title", plot.x_title},
            {"x_unit", plot.x_unit}, {"y_title", plot.y_title}, {"curves", Json::array()},
            {"looks", Json::array()}};
  for (const Plot::Curve& curve : plot.curves)
    json["curves"].push_back(
        {{"name", curve.name}, {"look", look_name(curve.look)}, {"x", curve.x}, {"y", curve.y}});
  for (const auto& [look, text] : plot.looks)
    json["looks"].push_back({{"look", look_name(look)}, {"text", text}});
  return json;
}

Json figure_json(const MeasuredFigure& one) {
  return {{"medium", one.medium},
          {"what", one.what},
          {"measured", one.measured},
          {"model", one.model},
          {"off", one.model / one.measured - 1.0},
          {"source", one.source}};
}

Json problem_json(const Problem& problem) {
  Json json{{"name", problem.name},
            {"title", problem.title},
            {"text", problem.text},
            {"error", problem.error},
            {"error_title", problem.error_title},
            {"error_unit", problem.error_unit},
            {"converged_to", number_or_null(problem.converged_to)},
            {"times_ticks", problem.times_ticks},
            {"plots", Json::array()},
            {"measured_text", problem.measured_text},
            {"measured", Json::array()}};
  for (const Plot& plot : problem.plots) json["plots"].push_back(plot_json(plot));
  for (const MeasuredFigure& one : problem.measured) json["measured"].push_back(figure_json(one));
  return json;
}

/// The settings of each subject, the fast ones first. front: no other is as exact and as fast.
Json advice_json(const std::vector<Advice>& advice) {
  Json json = Json::array();
  for (const Advice& one : advice) {
    Json settings = Json::array();
    for (const AdvisedSetting& setting : one.settings)
      settings.push_back({{"series", setting.series},
                          {"label", setting.label},
                          {"error", setting.error},
                          {"seconds", setting.seconds},
                          {"disturbed", setting.disturbed},
                          {"front", setting.front}});
    json.push_back({{"subject", one.subject}, {"problems", one.problems}, {"settings", std::move(settings)}});
  }
  return json;
}

}  // namespace

Json study_json(const Study& study) {
  const Table runs = runs_table(study.runs), orders = orders_table(study.orders);
  Json json{{"machine", describe_machine()},
            {"quick", study.quick},
            {"asked_errors", asked_errors},
            {"advice", advice_json(advise(study))},
            {"problems", Json::array()},
            {"columns", columns_json(runs)},
            {"runs", Json::array()},
            {"orders", Json::array()},
            {"estimates", Json::array()},
            {"notes", study.notes},
            {"disturbance", disturbance(study.runs)}};
  for (const Problem& problem : study.problems) json["problems"].push_back(problem_json(problem));
  for (std::size_t i = 0; i < study.runs.size(); ++i) {
    const std::vector<double>& slopes = study.runs[i].score.slope_errors;
    Json run = row_json(runs, i);
    run["pareto"] = study.runs[i].pareto;
    run["disturbed"] = study.runs[i].disturbed;
    run["directions"] = slopes.empty() ? Json() : Json(flank_directions());
    run["slope_error"] = slopes.empty() ? Json() : Json(slopes);
    json["runs"].push_back(std::move(run));
  }
  for (std::size_t i = 0; i < study.orders.size(); ++i) json["orders"].push_back(row_json(orders, i));
  for (const ErrorCheck& one : study.estimates)
    json["estimates"].push_back({{"problem", one.problem},
                                 {"label", one.label},
                                 {"quantity", one.quantity},
                                 {"estimate", number_or_null(one.estimate)},
                                 {"truth", number_or_null(one.truth)},
                                 {"ratio", number_or_null(one.estimate / one.truth)}});
  return json;
}

std::string bench_page(const Json& study) {
  return html_page("sandstroke bench", {.scripts = {SANDSTROKE_ASSET(bench_advice), SANDSTROKE_ASSET(bench)}},
                   study);
}

}  // namespace sandstroke
