#pragma once

#include <string>

#include "haptics/table_settings.h"
#include "import/sample_table.h"
#include "import/table_layout.h"

namespace sandstroke {

/// The times of a table's samples, before the samples without a value are left out.
struct TableTimes {
  std::vector<double> time;  ///< s, one per sample; NaN: it has none. Empty: a speed or nothing gives it
  double rate = 0.0;         ///< Hz, if a rate gives them
  std::optional<std::int64_t> clock;  ///< ns that a clock showed at time 0
  std::string text;                   ///< for people: "time t (ms)"
  std::vector<std::string> asks;      ///< what the user has to give
  std::vector<std::string> warnings;  ///< where the table says something else about its times
};

/// Takes times from the column that the layout names, or from a rate. is_second: of two tables that are
/// merged. Error: input, if the settings give times twice.
TableTimes table_times(const SampleTable& table, const TableLayout& layout, const TableSettings& settings,
                       const std::string& name, bool is_second);

/// The warning about a speed that replaces the times of a column; empty: they last about as long.
std::string speed_against_times(const SampleTable& table, const TableLayout& layout,
                                const TableSettings& settings, double duration);

}  // namespace sandstroke
