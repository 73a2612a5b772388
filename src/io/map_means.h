#pragma once

#include <vector>

#include "sand/cell_means.h"

namespace sandstroke {

/// The area means of a map over the cells of a bed, summed up line by line.
class MapMeans {
 public:
  /// lines, length: of the map; out_lines, out_length: of the bed, in the same directions.
  MapMeans(int lines, int length, int out_lines, int out_length);

  /// Adds the map's next line. has_gaps: some of its values are not-a-number, which is no data.
  void add(const std::vector<double>& line, bool has_gaps);

  /// Of each cell the mean of its data, times the fraction of the cell that has data.
  const HeightGrid& sums() const { return sums_; }
  /// The fraction of each cell that has none; empty: no line had gaps.
  const HeightGrid& missing() const { return missing_; }

 private:
  void sum_along(const std::vector<double>& line, bool has_gaps);

  std::vector<CellCover> across_, along_;
  int line_ = 0;
  std::size_t first_open_ = 0;  // the first line of the bed that may still get a part
  Eigen::Array<double, 1, Eigen::Dynamic> line_sums_, line_missing_;
  HeightGrid sums_, missing_;
};

}  // namespace sandstroke
