#pragma once

#include <vector>

#include "io/height_map.h"
#include "rules/talus.h"

namespace sandstroke {

/// All values of a map of rows, the first row being that of the smallest y.
inline HeightGrid values_of(HeightMap& map) {
  HeightGrid values(map.layout().rows, map.layout().cols);
  std::vector<double> line(static_cast<std::size_t>(map.line_length()));
  for (Eigen::Index i = 0; i < values.rows(); ++i) {
    map.next_line(line.data());
    const Eigen::Index row = map.layout().from_top ? values.rows() - 1 - i : i;
    values.row(row) = Eigen::Map<const Eigen::Array<double, 1, Eigen::Dynamic>>(line.data(), values.cols());
  }
  return values;
}

}  // namespace sandstroke
