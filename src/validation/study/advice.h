#pragma once

#include <string>
#include <vector>

#include "validation/study/study.h"

namespace sandstroke {

/// One way to compute a subject: how exact it is, and its cost.
struct AdvisedSetting {
  std::string series, label;
  double error;    ///< the largest in the subject's problems; never below that of a problem's own reference
  double seconds;  ///< the longest run in these problems
  bool disturbed;
  bool front;  ///< no other setting has as small an error and time
};

/// The settings that ran in every problem of a subject (Problem::subject), the fast ones first. Rules from
/// outside the program are left out.
struct Advice {
  std::string subject;
  std::vector<std::string> problems;  ///< their titles
  std::vector<AdvisedSetting> settings;

  /// The fastest setting with at most this error; nullptr if there is none.
  const AdvisedSetting* within(double error) const;
  const AdvisedSetting& most_exact() const;
};

/// The errors that people ask for: fractions of the sand that moves.
inline constexpr double asked_errors[] = {0.2, 0.1, 0.05, 0.02, 0.01, 0.005};

/// Advice on every subject of the study with at least one setting, in the order of its problems.
std::vector<Advice> advise(const Study& study);

}  // namespace sandstroke
