#pragma once

#include <string>
#include <vector>

#include "validation/study/study.h"

namespace sandstroke {

/// Says how many runs a busy machine disturbed. Empty: none.
std::string disturbance(const std::vector<StudyRun>& runs);

/// The result for a terminal: advice, the fastest and the nearest run of each problem, and the orders.
std::string study_summary(const Study& study);

}  // namespace sandstroke
