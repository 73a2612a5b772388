#pragma once

#include <vector>

#include "sand/cell_means.h"

namespace sandstroke {

/// The area means of a map over the cells of a bed, made line by line.
class MapMeans {
 public:
  /// sums: of each cell the mean of its data, times the fraction of the cell that has data.
  /// running: the mean, kept after each value, so that equal values have it to the bit; not-a-number where a
  /// value is that.
  enum class Way { sums, running };

  /// lines, length: of the map; out_lines, out_length: of the bed, in the same directions.
  MapMeans(int lines, int length, int out_lines, int out_length, Way way = Way::sums);

  /// Adds the map's next line. has_gaps: some of its values are not-a-number, which is no data (sums).
  void add(const std::vector<double>& line, bool has_gaps);

  const HeightGrid& means() const { return means_; }
  /// The fraction of each cell that has no data; empty: no line had gaps.
  const HeightGrid& missing() const { return missing_; }

 private:
  /// The next value's part in a sum, or in a running mean.
  double joined(double before, double part, double value) const {
    return before + part * (way_ == Way::running ? value - before : value);
  }
  void join_along(const std::vector<double>& line, bool has_gaps);

  Way way_;
  std::vector<CellCover> across_, along_;
  int line_ = 0;
  std::size_t first_open_ = 0;  // the first line of the bed that may still get a part
  Eigen::Array<double, 1, Eigen::Dynamic> line_means_, line_missing_;
  HeightGrid means_, missing_;
};

/// The means of values in the cells of another grid over the same rectangle. Equal values stay equal to the
/// bit.
HeightGrid running_means(const HeightGrid& values, int rows, int cols);

}  // namespace sandstroke
