#include "validation/study/advice.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace sandstroke {
namespace {

/// The runs of a subject by series and label, in the order of the study, and in how many problems each ran.
struct Judged {
  AdvisedSetting setting;
  std::size_t problems;
};

void add_runs(const Study& study, const Problem& problem, std::vector<Judged>& judged) {
  for (const StudyRun& run : study.runs) {
    if (run.problem != problem.name || run.external || std::isnan(run.error)) continue;
    const double error = std::max(run.error, problem.least_error());
    const auto found = std::find_if(judged.begin(), judged.end(), [&](const Judged& one) {
      return one.setting.series == run.series && one.setting.label == run.label;
    });
    if (found == judged.end()) {
      judged.push_back({{run.series, run.label, error, run.wall_seconds, run.disturbed, false}, 1});
      continue;
    }
    AdvisedSetting& worst = found->setting;
    worst.error = std::max(worst.error, error);
    worst.seconds = std::max(worst.seconds, run.wall_seconds);
    worst.disturbed = worst.disturbed || run.disturbed;
    ++found->problems;
  }
}

}  // namespace

const AdvisedSetting* Advice::within(double error) const {
  for (const AdvisedSetting& one : settings)
    if (one.error <= error) return &one;
  return nullptr;
}

const AdvisedSetting& Advice::most_exact() const {
  return *std::min_element(
      settings.begin(), settings.end(),
      [](const AdvisedSetting& a, const AdvisedSetting& b) { return a.error < b.error; });
}

std::vector<Advice> advise(const Study& study) {
  std::vector<Advice> advice;
  std::map<std::string, std::vector<Judged>> judged;
  for (const Problem& problem : study.problems) {
    if (problem.subject.empty()) continue;
    if (!judged.contains(problem.subject)) advice.push_back({problem.subject, {}, {}});
    add_runs(study, problem, judged[problem.subject]);
    for (Advice& one : advice)
      if (one.subject == problem.subject) one.problems.push_back(problem.title);
  }
  for (Advice& one : advice) {
    for (const Judged& run : judged[one.subject])
      if (run.problems == one.problems.size()) one.settings.push_back(run.setting);
    std::stable_sort(one.settings.begin(), one.settings.end(),
                     [](const AdvisedSetting& a, const AdvisedSetting& b) { return a.seconds < b.seconds; });
    double least = std::numeric_limits<double>::infinity();
    for (AdvisedSetting& setting : one.settings) {
      setting.front = setting.error < least;
      least = std::min(least, setting.error);
    }
  }
  std::erase_if(advice, [](const Advice& one) { return one.settings.empty(); });
  return advice;
}

}  // namespace sandstroke
