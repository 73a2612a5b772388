#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "haptics/table_settings.h"
#include "import/sample_table.h"

namespace sandstroke {

/// A column of a table, and whether its sign changes.
struct ColumnChoice {
  std::size_t column = 0;
  double sign = 1.0;
};
using ColumnChoices = std::vector<ColumnChoice>;

/// The columns of a table by their meaning.
struct TableLayout {
  ColumnChoices position;         ///< 2 or 3; none in a second table
  ColumnChoices velocity, force;  ///< 2 or 3, or none
  ColumnChoices orientation;      ///< 4, 9 or none
  std::optional<std::size_t> time, pressure;
  /// Columns that only check others: times that a rate or a speed replaces, and numbers of the samples.
  std::optional<std::size_t> replaced_time, sample_number;
  std::optional<std::size_t>
      time_fraction;  ///< the time (or replaced one) counts seconds, and this ms, us or ns
  std::optional<std::size_t> stroke_number;  ///< the pen lifts where its value changes
  std::optional<std::size_t> pen_state;      ///< the pen is down where it is not 0, or up if state_is_up
  bool state_is_up = false;
  bool state_named_up = false;  ///< its name says up, as "hover" does
  /// Columns whose names do not tell clearly; none, if clear ones were found.
  std::vector<std::size_t> perhaps_stroke_number, perhaps_pen_state;
  /// From the table's axes to the stroke's: its rows are the positions' columns.
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
  std::vector<std::string> notes;     ///< for the description: what is left out
  std::vector<std::string> warnings;  ///< a sentence each, without the table's name
};

/// Takes the columns that the settings name, and else those whose names tell their meaning. of_first: the
/// axes of the first table, with which this one is merged, and which has the position then. The columns may
/// have no values yet. Error: input, also if two choices are equally good; `location` says where the names
/// stand.
TableLayout table_layout(const std::vector<SampleColumn>& columns, const TableSettings& settings,
                         const std::string& location, const std::optional<Eigen::Matrix3d>& of_first = {});

}  // namespace sandstroke
