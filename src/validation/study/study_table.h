#pragma once

#include "io/table.h"
#include "validation/study/study.h"

namespace sandstroke {

/// Every column of a run: what files, page and terminal show.
Table runs_table(const std::vector<StudyRun>& runs);
Table orders_table(const std::vector<ConvergenceOrder>& orders);

/// The number that a column holds for a run.
double number_in(const std::string& column, const StudyRun& run);

/// What the page draws (report/assets/bench.js).
nlohmann::ordered_json study_json(const Study& study);

/// The result for a terminal: the fastest and the nearest of each problem, and the orders.
std::string study_summary(const Study& study);

}  // namespace sandstroke
