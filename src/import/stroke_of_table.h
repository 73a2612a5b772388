#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "haptics/stroke.h"
#include "haptics/table_settings.h"
#include "import/sample_table.h"

namespace sandstroke {

/// A stroke, and messages about how it was made.
struct ImportedStroke {
  Stroke stroke;
  std::string description;            ///< one line: what was found, and how each column was used
  std::vector<std::string> warnings;  ///< a sentence each
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();  ///< from the table's axes to the stroke's
  std::optional<std::int64_t> clock;  ///< ns that the table's clock showed at time 0; none: no clock's stamps
};

/// Makes a stroke from a table as the settings say; what they leave open, names and units of the columns
/// tell. of_first: the axes of the first table, with which this one is merged; positions are 0 then. The
/// caller does the settings' merge. Error: input; `name` is the table's.
ImportedStroke stroke_of_table(SampleTable table, const TableSettings& settings, const std::string& name,
                               const std::optional<Eigen::Matrix3d>& of_first = {});

}  // namespace sandstroke
