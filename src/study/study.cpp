#include "study/study.h"

#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "core/error.h"
#include "core/interrupt.h"
#include "study/study_table.h"

namespace sandstroke {
namespace {

/// How long one run may take, and all repeats of it [s].
struct TimeLimits {
  double run, repeats;
};

/// Plain passes over n x n cells number n^2: with twice the cells a run takes 16 times as long at worst.
double foreseen_seconds(const StudyRun& smaller, const RunSettings& larger) {
  const double ratio = larger.cells / smaller.settings.cells;
  return smaller.wall_seconds * (std::isnan(ratio) ? 1.0 : std::pow(std::max(1.0, ratio), 4.0));
}

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
      throw_input_error("there is no problem '{}'; take one of: {}", name, known);
  return chosen;
}

/// The contenders of one problem, their repeats in turn.
class Race {
 public:
  Race(const Problem& problem, const TimeLimits& limits, Study& study)
      : problem_(problem), limits_(limits), study_(study) {}

  /// progress: share of this problem that is done.
  std::vector<StudyRun> run(int repeats, const std::function<void(double)>& progress) {
    const std::size_t count = problem_.contenders.size();
    runs_.resize(count), seconds_.resize(count);
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
    return runs_[i].repeats > 0 && (runs_[i].repeats + 1) * runs_[i].wall_seconds <= limits_.repeats;
  }

  /// Whether the time limit allows a first run, judged by the series' last.
  bool fits(std::size_t i) {
    const Contender& contender = problem_.contenders[i];
    for (std::size_t j = i; j-- > 0;) {
      if (problem_.contenders[j].series != contender.series) continue;
      if (runs_[j].repeats == 0) return left_out(contender, "a coarser run was");
      const double foreseen = foreseen_seconds(runs_[j], contender.settings);
      return foreseen <= limits_.run ||
             left_out(contender,
                      fmt::format("it might take {:.0f} s (limit {:.0f} s)", foreseen, limits_.run));
    }
    return true;
  }
  bool left_out(const Contender& contender, const std::string& why) {
    study_.notes.push_back(
        fmt::format("{}: {}, {}: left out, for {}.", problem_.title, contender.series, contender.label, why));
    return false;
  }

  void run_once(std::size_t i) {
    const Contender& contender = problem_.contenders[i];
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(contender.settings.threads));
    const Trial trial = contender.run();
    StudyRun& run = runs_[i];
    run.problem = problem_.name, run.series = contender.series, run.label = contender.label;
    run.settings = contender.settings;
    run.step = contender.step;
    run.score = trial.score;
    std::vector<double>& seconds = seconds_[i];
    seconds.insert(std::upper_bound(seconds.begin(), seconds.end(), trial.seconds), trial.seconds);
    run.wall_seconds = 0.5 * (seconds[(seconds.size() - 1) / 2] + seconds[seconds.size() / 2]);
    run.least_seconds = seconds.front(), run.largest_seconds = seconds.back();
    run.repeats = static_cast<double>(seconds.size());
    run.error = number_in(problem_.error, run);
  }

  const Problem& problem_;
  const TimeLimits limits_;
  Study& study_;
  std::vector<StudyRun> runs_;
  std::vector<std::vector<double>> seconds_;  // of each run's repeats, sorted
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
    order.problem = problem.name, order.series = series, order.error = problem.error;
    orders.push_back(order);
  }
}

}  // namespace

void mark_pareto(std::vector<StudyRun>& runs) {
  for (StudyRun& run : runs)
    run.pareto = !std::isnan(run.error) && std::none_of(runs.begin(), runs.end(), [&](const StudyRun& other) {
      return other.problem == run.problem && other.error <= run.error &&
             other.wall_seconds <= run.wall_seconds &&
             (other.error < run.error || other.wall_seconds < run.wall_seconds);
    });
}

namespace {

/// The 97.5 % point of Student's t: exact to the digits for up to 10 degrees of freedom, above by its
/// expansion in 1/freedom.
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
    x += std::log(step) / n, y += std::log(error) / n;
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
  fit.low = fit.order - half, fit.high = fit.order + half;
  return fit;
}

Study run_study(const StudyOptions& options) {
  const std::vector<ProblemMaker> makers = chosen_makers(options.problems);
  const int repeats = options.repeats > 0 ? options.repeats : options.quick ? 3 : 5;
  const TimeLimits limits = options.quick ? TimeLimits{2.0, 0.5} : TimeLimits{15.0, 8.0};
  Study study;
  study.quick = options.quick;
  const auto share = 1.0 / static_cast<double>(makers.size());
  for (std::size_t i = 0; i < makers.size() && !interrupted(); ++i) {
    const tbb::global_control threads(tbb::global_control::max_allowed_parallelism,
                                      static_cast<std::size_t>(options.threads));
    study.problems.push_back(makers[i].make(options));
    const Problem& problem = study.problems.back();
    std::vector<StudyRun> runs = Race(problem, limits, study).run(repeats, [&](double done) {
      options.progress(share * (static_cast<double>(i) + done));
    });
    mark_pareto(runs);
    add_orders(problem, runs, study.orders);
    study.runs.insert(study.runs.end(), runs.begin(), runs.end());
  }
  return study;
}

}  // namespace sandstroke
