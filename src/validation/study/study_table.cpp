#include "validation/study/study_table.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>

#include "core/asset.h"
#include "core/error.h"
#include "report/page.h"
#include "validation/study/surface_error.h"

SANDSTROKE_DECLARE_ASSET(bench);

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

/// The problem's fastest run with at most twice the least error, and the run with the least error.
std::vector<const StudyRun*> best_of(const std::vector<StudyRun>& runs, const std::string& problem) {
  const StudyRun *nearest = nullptr, *fastest = nullptr;
  const auto in_race = [&](const StudyRun& run) { return run.pareto && run.problem == problem; };
  for (const StudyRun& run : runs)
    if (in_race(run) && (!nearest || run.error < nearest->error)) nearest = &run;
  for (const StudyRun& run : runs)
    if (in_race(run) && run.error <= 2.0 * nearest->error &&
        (!fastest || run.wall_seconds < fastest->wall_seconds))
      fastest = &run;
  if (fastest == nearest) return nearest ? std::vector{nearest} : std::vector<const StudyRun*>{};
  return {fastest, nearest};
}

std::string title_of(const Study& study, const std::string& problem) {
  for (const Problem& one : study.problems)
    if (one.name == problem) return one.title;
  return problem;
}

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

/// "*" beside the time of a disturbed run.
std::string mark_of(const StudyRun& run) { return run.disturbed ? "*" : ""; }

/// Says how many runs a busy machine disturbed. Empty: none.
std::string disturbance(const std::vector<StudyRun>& runs) {
  const auto disturbed =
      std::count_if(runs.begin(), runs.end(), [](const StudyRun& run) { return run.disturbed; });
  if (disturbed == 0) return "";
  return fmt::format(
      "{} of {} runs (marked *) were disturbed by other programs: their repeats differ by more than 20 %, or "
      "waited "
      "for a processor. Their times may be too long. Measure again when nothing else runs.",
      disturbed, runs.size());
}

/// The time of a tick under each law, and its ratio to the paper's.
std::string ticks_text(const std::vector<StudyRun>& runs) {
  std::vector<std::string> tools, labels, laws, marks;
  std::vector<double> times, of_paper;
  for (const StudyRun& run : runs) {
    if (std::isnan(run.of_paper)) continue;
    tools.push_back(run.settings.tool);
    labels.push_back(run.label);
    laws.push_back(run.settings.force_law);
    times.push_back(run.error);
    of_paper.push_back(run.of_paper);
    marks.push_back(mark_of(run));
  }
  if (times.empty()) return "";
  return "\nTime of a tick\n" + aligned_text({{{"tool", "Tool", "", tools},
                                               {"label", "Settings", "", labels},
                                               {"force_law", "Force law", "", laws},
                                               {"tick_microseconds", "Time", "us", times},
                                               {"of_paper", "Over paper", "", of_paper},
                                               {"disturbed", "", "", marks}}},
                                             3);
}

}  // namespace

Json study_json(const Study& study) {
  const Table runs = runs_table(study.runs), orders = orders_table(study.orders);
  Json json{
      {"machine", describe_machine()}, {"quick", study.quick},  {"problems", Json::array()},
      {"columns", columns_json(runs)}, {"runs", Json::array()}, {"orders", Json::array()},
      {"estimates", Json::array()},    {"notes", study.notes},  {"disturbance", disturbance(study.runs)}};
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
  return html_page("sandstroke bench", {.scripts = {SANDSTROKE_ASSET(bench)}}, study);
}

namespace {

/// Writes these columns of runs_table() for some runs, and their errors.
std::string runs_text(const Study& study, const std::vector<StudyRun>& runs,
                      std::initializer_list<const char*> names) {
  std::vector<double> errors;
  std::vector<std::string> marks;
  for (const StudyRun& run : runs) {
    errors.push_back(run.error);
    marks.push_back(mark_of(run));
  }
  Table table;
  const Table all = runs_table(runs);
  for (const char* name : names)
    for (const TableColumn& column : all.columns)
      if (column.name == name) table.columns.push_back(column);
  table.columns.push_back({"error", "Error", "", errors});
  table.columns.push_back({"disturbed", "", "", marks});
  for (TableColumn& column : table.columns)
    if (column.name == "problem")
      for (std::string& name : std::get<std::vector<std::string>>(column.values))
        name = title_of(study, name);
  return aligned_text(table, 3);
}

}  // namespace

std::string study_summary(const Study& study) {
  std::vector<StudyRun> best, external;
  for (const Problem& problem : study.problems) {
    const std::vector<const StudyRun*> ends = best_of(study.runs, problem.name);
    for (const StudyRun* run : ends) best.push_back(*run);
  }
  for (const StudyRun& run : study.runs)
    if (run.external) external.push_back(run);
  std::string text = "Most accurate run, and fastest run with at most twice its error\n" +
                     runs_text(study, best, {"problem", "series", "label", "wall_seconds", "passes"});
  if (!external.empty())
    text += "\nRules from outside the program (converged: 1 = at rest; drift: fraction of the moved sand)\n" +
            runs_text(study, external,
                      {"problem", "series", "label", "wall_seconds", "passes", "converged", "volume_drift"});
  if (!study.orders.empty())
    text += "\nOrders of convergence\n" + aligned_text(orders_table(study.orders), 3);
  text += ticks_text(study.runs);
  for (const Problem& problem : study.problems)
    if (!std::isnan(problem.converged_to))
      text += fmt::format("\n{}: the reference has an error of about {:.2g}\n", problem.title,
                          problem.converged_to);
  for (const std::string& note : study.notes) text += "\n" + note + "\n";
  if (const std::string said = disturbance(study.runs); !said.empty()) text += "\n* " + said + "\n";
  return text;
}

}  // namespace sandstroke
