#pragma once

#include <map>
#include <string>
#include <vector>

#include "validation/study/study.h"

namespace sandstroke {

/// The errors of each series of a quick problem, the coarse runs first.
inline std::map<std::string, std::vector<double>> errors_of(const std::string& problem) {
  StudyOptions options;
  options.quick = true;
  options.problems = {problem};
  options.repeats = 1;
  std::map<std::string, std::vector<double>> errors;
  for (const StudyRun& run : run_study(options).runs) errors[run.series].push_back(run.error);
  return errors;
}

}  // namespace sandstroke
