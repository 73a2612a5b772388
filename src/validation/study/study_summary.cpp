#include "validation/study/study_summary.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>

#include "validation/study/advice.h"
#include "validation/study/study_table.h"

namespace sandstroke {

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

namespace {

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

/// "*" beside the time of a disturbed run.
std::string mark_of(const StudyRun& run) { return run.disturbed ? "*" : ""; }

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

/// A row for each subject and error that people ask for, while a setting reaches it.
std::string advice_text(const std::vector<Advice>& advice) {
  std::vector<std::string> subjects, errors, settings, marks;
  std::vector<double> seconds, reached;
  const auto add = [&](const Advice& one, std::string error, const AdvisedSetting& setting) {
    subjects.push_back(one.subject);
    errors.push_back(std::move(error));
    settings.push_back(setting.series + ", " + setting.label);
    seconds.push_back(setting.seconds);
    reached.push_back(100.0 * setting.error);
    marks.push_back(setting.disturbed ? "*" : "");
  };
  for (const Advice& one : advice) {
    if (!one.within(asked_errors[0])) add(one, "as exact as it gets", one.most_exact());
    for (const double error : asked_errors)
      if (const AdvisedSetting* setting = one.within(error))
        add(one, fmt::format("{:.3g} %", 100.0 * error), *setting);
  }
  if (subjects.empty()) return "";
  return "For this error, take this setting, at this cost\n" +
         aligned_text({{{"subject", "Subject", "", subjects},
                        {"error", "Error at most", "", errors},
                        {"setting", "Setting", "", settings},
                        {"seconds", "Time", "s", seconds},
                        {"reached", "Its error", "%", reached},
                        {"disturbed", "", "", marks}}},
                      3) +
         "\n";
}

}  // namespace

std::string study_summary(const Study& study) {
  std::vector<StudyRun> best, external;
  for (const Problem& problem : study.problems)
    for (const StudyRun* run : best_of(study.runs, problem.name)) best.push_back(*run);
  for (const StudyRun& run : study.runs)
    if (run.external) external.push_back(run);
  std::string text = advice_text(advise(study));
  text += "Most accurate run, and fastest run with at most twice its error\n" +
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
