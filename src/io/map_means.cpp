#include "io/map_means.h"

#include <cmath>

namespace sandstroke {

MapMeans::MapMeans(int lines, int length, int out_lines, int out_length)
    : across_(cell_covers(out_lines, lines)),
      along_(cell_covers(out_length, length)),
      line_sums_(out_length),
      line_missing_(out_length),
      sums_(HeightGrid::Zero(out_lines, out_length)) {}

void MapMeans::add(const std::vector<double>& line, bool has_gaps) {
  sum_along(line, has_gaps);
  if (has_gaps && missing_.size() == 0) missing_ = HeightGrid::Zero(sums_.rows(), sums_.cols());
  for (std::size_t out = first_open_; out < across_.size() && across_[out].begin <= line_; ++out) {
    const CellCover& cover = across_[out];
    const auto part = static_cast<std::size_t>(line_ - cover.begin);
    if (part >= cover.fraction.size()) {
      first_open_ = out + 1;
      continue;
    }
    const auto row = static_cast<Eigen::Index>(out);
    sums_.row(row) += cover.fraction[part] * line_sums_;
    if (has_gaps) missing_.row(row) += cover.fraction[part] * line_missing_;
  }
  ++line_;
}

void MapMeans::sum_along(const std::vector<double>& line, bool has_gaps) {
  for (std::size_t out = 0; out < along_.size(); ++out) {
    const CellCover& cover = along_[out];
    double sum = 0.0, gap = 0.0;
    for (std::size_t k = 0; k < cover.fraction.size(); ++k) {
      const double value = line[static_cast<std::size_t>(cover.begin) + k];
      const bool missing = has_gaps && std::isnan(value);
      (missing ? gap : sum) += cover.fraction[k] * (missing ? 1.0 : value);
    }
    line_sums_[static_cast<Eigen::Index>(out)] = sum;
    line_missing_[static_cast<Eigen::Index>(out)] = gap;
  }
}

}  // namespace sandstroke
