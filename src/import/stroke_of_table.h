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

/// A stroke, and what is to be said of how it was made.
struct ImportedStroke {
  Stroke stroke;
  std::string description;            ///< one line: what was seen, and what was taken as what
  std::vector<std::string> warnings;  ///< a sentence each
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();  ///< from the table's to the stroke's
  std::optional<std::int64_t> clock;  ///< ns that the table's clock showed at time 0; none: it began at 0
};

/// Makes a stroke of a table as its settings say, and what they do not say as names and units of the columns
/// do. With the axes of a first table, with which it is merged, positions are 0. The settings' merge is left
/// to who reads files. Error: input; `name` is the table's.
ImportedStroke stroke_of_table(const SampleTable& table, const TableSettings& settings,
                               const std::string& name, const std::optional<Eigen::Matrix3d>& of_first = {});

}  // namespace sandstroke
