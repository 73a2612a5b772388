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

/// Which columns of a table are what.
struct TableLayout {
  ColumnChoices position;         ///< 2 or 3; none where it was not asked for
  ColumnChoices velocity, force;  ///< 2 or 3, or none
  ColumnChoices orientation;      ///< 4, 9 or none
  std::optional<std::size_t> time, pressure;
  /// From the axes that the table is in to the stroke's: its rows are the positions' columns.
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
};

/// Columns are those that the settings name, and else those whose names say it. `of_first`: the axes of the
/// table with which this one is merged, which has the position then. Values may still be missing. Error:
/// input; `place` says where the names stand.
TableLayout table_layout(const std::vector<SampleColumn>& columns, const TableSettings& settings,
                         const std::string& place, const std::optional<Eigen::Matrix3d>& of_first = {});

/// The option of `stroke convert` for a key: "--position-unit".
std::string option_of(const std::string& key);
/// An option of `stroke convert` and its key, as sentences have them: "--rate (in a scene:
/// stroke.table.rate)".
std::string option_and_key(const std::string& key);

}  // namespace sandstroke
