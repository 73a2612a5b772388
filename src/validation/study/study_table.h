#pragma once

#include "io/table.h"
#include "validation/study/study.h"

namespace sandstroke {

/// All columns of all runs, for files, page and terminal.
Table runs_table(const std::vector<StudyRun>& runs);
Table orders_table(const std::vector<ConvergenceOrder>& orders);

/// The run's number in a column.
double number_in(const std::string& column, const StudyRun& run);

/// The data that the page draws (assets/bench.js).
nlohmann::ordered_json study_json(const Study& study);

/// The page that draws them, as HTML.
std::string bench_page(const nlohmann::ordered_json& study);

}  // namespace sandstroke
