#include "validation/study/study.h"

#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "core/error.h"
#include "core/interrupt.h"
#include "core/stopwatch.h"
#include "validation/study/study_table.h"

namespace sandstroke {
namespace {

/// The limits of a bench. Cells, not seconds, decide which runs are left out, so that a busy machine leaves
/// out the same. A cell takes 5 to 20 ns.
struct Limits {
  double cells_visited;  // by one run
  double seconds;        // by all repeats of a run after the first
};

std::vector<ProblemMaker> chosen_makers(const std::vector<std::string>& names) {
  if (names.empty()) return problem_makers();
  std::vector<ProblemMaker> chosen;
  std::string known;
  for (const ProblemMaker& maker : problem_makers()) {
    known += (known.empty() ? "" : ", ") + std::string(maker.name);
    if (std::find(names.begin(), names.end(), maker.name) != names.end()) chosen.push_back(maker);
  }
  for (const std::string& name : names)
    if (std::none_of(chosen.begin(), chosen.end(), [&](const ProblemMaker& one) { return name == one.name; }))
      throw_input_error("unknown problem '{}'; use one of: {}", name, known);
  return chosen;
}

/// Estimates how many cells a run will visit, from the last one or two runs of its series. (n x n cells need
/// n^2 plain passes, which visit n^4 cells.)
double foreseen_visits(double cells, const StudyRun& last, const StudyRun* before) {
  const double ratio = cells / last.settings.cells;
  if (!(ratio > 1.0)) return last.score.cells_visited;
  double power = 4.0;
  if (before && before->settings.cells < last.settings.cells)
    power = std::log(last.score.cells_visited / before->score.cells_visited) /
            std::log(last.settings.cells / before->settings.cells);
  return last.score.cells_visited * std::pow(ratio, power);
}

/// Runs the contenders of one problem, and takes their repeats in turn.
class Race {
 public:
  Race(const Problem& problem, const Limits& limits, Study& study)
      : problem_(problem), limits_(limits), study_(study) {}

  /// progress gets the fraction of this problem that is done.
  std::vector<StudyRun> run(int repeats, const std::function<void(double)>& progress) {
    const std::size_t count = problem_.contenders.size();
    runs_.resize(count);
    seconds_.resize(count);
    waited_.resize(count);
    for (int repeat = 0; repeat < repeats; ++repeat)
      for (std::size_t i = 0; i < count; ++i) {
        if (interrupted()) return {};
        if (repeat == 0 ? fits(i) : goes_on(i)) run_once(i);
        progress(static_cast<double>(repeat * count + i + 1) / static_cast<double>(repeats * count));
      }
    std::erase_if(runs_, [](const StudyRun& run) { return run.repeats == 0; });
    return std::move(runs_);
  }

 private:
  bool goes_on(std::size_t i) const {
    return runs_[i].repeats > 0 && (runs_[i].repeats + 1) * runs_[i].wall_seconds <= limits_.seconds;
  }

  /// True if the limit allows at least one run.
  bool fits(std::size_t i) {
    const Contender& contender = problem_.contenders[i];
    const StudyRun *last = nullptr, *before = nullptr;  // runs of the same series
    for (std::size_t j = 0; j < i; ++j)
      if (problem_.contenders[j].series == contender.series) {
        before = last;
        last = &runs_[j];
      }
    if (!last) return true;
    if (last->repeats == 0) return left_out(contender, "a coarser run was left out or failed");
    const double foreseen = foreseen_visits(contender.settings.cells, *last, before);
    return !(foreseen > limits_.cells_visited) ||
           left_out(contender, fmt::format("it would visit some {:.0e} cells (limit {:.0e})", foreseen,
                                           limits_.cells_visited));
  }
  bool left_out(const Contender& contender, const std::string& why) {
    study_.notes.push_back(fmt::format("{}: {}, {}: left out, because {}.", problem_.title, contender.series,
                                       contender.label, why));
    return false;
  }

  void run_once(std::size_t i) {
    const Contender& contender = problem_.contenders[i];
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(contender.settings.threads));
    Trial trial;
    const Stopwatch watch;
    const double worked_before = processor_seconds();
    try {
      trial = contender.run();
    } catch (const Error& failure) {
      if (!contender.external) throw;
      runs_[i].repeats = 0;
      study_.notes.push_back(fmt::format("{}: {}, {}: failed: {}.", problem_.title, contender.series,
                                         contender.label, failure.what()));
      return;
    }
    StudyRun& run = runs_[i];
    run.problem = problem_.name;
    run.series = contender.series;
    run.label = contender.label;
    run.settings = contender.settings;
    run.step = contender.step;
    run.external = contender.external;
    run.score = trial.score;
    // Only for one thread the program knows how long it waited for a processor.
    const double idle_fraction =
        contender.settings.threads == 1 ? 1.0 - (processor_seconds() - worked_before) / watch.seconds() : 0.0;
    std::vector<double>& seconds = seconds_[i];
    seconds.insert(std::upper_bound(seconds.begin(), seconds.end(), trial.seconds), trial.seconds);
    if (trial.seconds == seconds.front()) waited_[i] = idle_fraction * trial.seconds;
    run.wall_seconds = seconds.front();
    run.median_seconds = 0.5 * (seconds[(seconds.size() - 1) / 2] + seconds[seconds.size() / 2]);
    run.largest_seconds = seconds.back();
    run.repeats = static_cast<double>(seconds.size());
    run.disturbed = is_disturbed(run.wall_seconds, run.largest_seconds, waited_[i]);
    run.error = number_in(problem_.error, run);
  }

  const Problem& problem_;
  const Limits limits_;
  Study& study_;
  std::vector<StudyRun> runs_;
  std::vector<std::vector<double>> seconds_;  // the repeats of each run, sorted
  std::vector<double> waited_;                // s, waiting time of each run's fastest repeat
};

void add_orders(const Problem& problem, const std::vector<StudyRun>& runs,
                std::vector<ConvergenceOrder>& orders) {
  std::vector<std::string> names;
  std::map<std::string, std::vector<std::pair<double, double>>> points;
  for (const StudyRun& run : runs) {
    if (std::isnan(run.step) || !(run.error > 0.0)) continue;
    if (!points.contains(run.series)) names.push_back(run.series);
    points[run.series].emplace_back(run.step, run.error);
  }
  for (const std::string& series : names) {
    ConvergenceOrder order = fit_order(points[series]);
    if (std::isnan(order.order)) continue;
    order.problem = problem.name;
    order.series = series;
    order.error = problem.error;
    orders.push_back(order);
  }
}

}  // namespace

bool is_disturbed(double least, double largest, double waited) {
  constexpr double borne = 0.2;
  return largest - least > borne * least || waited > borne * least;
}

void mark_pareto(std::vector<StudyRun>& runs, double least) {
  const auto error_of = [&](const StudyRun& run) { return std::max(run.error, least); };
  for (StudyRun& run : runs)
    run.pareto = !std::isnan(run.error) && std::none_of(runs.begin(), runs.end(), [&](const StudyRun& other) {
      return other.problem == run.problem && error_of(other) <= error_of(run) &&
             other.wall_seconds <= run.wall_seconds &&
             (error_of(other) < error_of(run) || other.wall_seconds < run.wall_seconds);
    });
}

void compare_ticks(std::vector<StudyRun>& runs) {
  for (StudyRun& run : runs)
    for (const StudyRun& other : runs)
      if (other.settings.force_law == "paper" && other.settings.tool == run.settings.tool &&
          other.label == run.label) {
        run.of_paper = run.error / other.error;
        run.disturbed = run.disturbed || other.disturbed;
      }
}

namespace {

/// The 97.5 % point of Student's t: from a table for up to 10 degrees of freedom, above that by its expansion
/// in 1/freedom.
double student_t(int freedom) {
  constexpr double table[] = {12.706, 4.303, 3.182, 2.776, 2.571, 2.447, 2.365, 2.306, 2.262, 2.228};
  if (freedom <= 10) return table[freedom - 1];
  return 1.960 + 2.372 / freedom + 2.82 / (freedom * freedom);
}

}  // namespace

ConvergenceOrder fit_order(const std::vector<std::pair<double, double>>& points) {
  const auto n = static_cast<double>(points.size());
  std::vector<double> steps;
  double x = 0.0, y = 0.0;
  for (const auto& [step, error] : points) {
    steps.push_back(step);
    x += std::log(step) / n;
    y += std::log(error) / n;
  }
  std::sort(steps.begin(), steps.end());
  ConvergenceOrder fit{
      {}, {}, {}, not_applicable, not_applicable, not_applicable, static_cast<int>(points.size())};
  if (std::unique(steps.begin(), steps.end()) - steps.begin() < 3) return fit;
  double xx = 0.0, xy = 0.0, left = 0.0;
  for (const auto& [step, error] : points) {
    xx += std::pow(std::log(step) - x, 2);
    xy += (std::log(step) - x) * (std::log(error) - y);
  }
  fit.order = xy / xx;
  for (const auto& [step, error] : points)
    left += std::pow(std::log(error) - y - fit.order * (std::log(step) - x), 2);
  const int freedom = fit.points - 2;
  const double half = student_t(freedom) * std::sqrt(left / freedom / xx);
  fit.low = fit.order - half;
  fit.high = fit.order + half;
  return fit;
}

namespace {

/// Makes a problem with a thread limit. The limit ends here: an inner limit of TBB cannot raise an outer one,
/// and contenders set their own.
Problem make(const ProblemMaker& maker, const ProblemOptions& options) {
  const tbb::global_control threads(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(options.threads));
  return maker.make(options);
}

}  // namespace

Study run_study(const StudyOptions& options) {
  const std::vector<ProblemMaker> makers = chosen_makers(options.problems);
  const int repeats = options.repeats > 0 ? options.repeats : options.quick ? 3 : 5;
  const Limits limits = options.quick ? Limits{5e7, 0.5} : Limits{1.5e9, 8.0};
  Study study;
  study.quick = options.quick;
  const auto fraction = 1.0 / static_cast<double>(makers.size());
  for (std::size_t i = 0; i < makers.size() && !interrupted(); ++i) {
    study.problems.push_back(make(makers[i], options));
    const Problem& problem = study.problems.back();
    std::vector<StudyRun> runs = Race(problem, limits, study).run(repeats, [&](double done) {
      options.progress(fraction * (static_cast<double>(i) + done));
    });
    if (problem.times_ticks) {
      compare_ticks(runs);
    } else {
      mark_pareto(runs, problem.least_error());
      add_orders(problem, runs, study.orders);
    }
    study.runs.insert(study.runs.end(), runs.begin(), runs.end());
    if (!problem.check_errors || interrupted()) continue;
    for (ErrorCheck& check : problem.check_errors()) {
      check.problem = problem.name;
      study.estimates.push_back(std::move(check));
    }
  }
  return study;
}

}  // namespace sandstroke
