#include "sand/map_means.h"

#include <cmath>

namespace sandstroke {
namespace {

/// The covers, with each fraction as the part of what came so far that it is: the first is all of it.
std::vector<CellCover> as_running_parts(std::vector<CellCover> covers) {
  for (CellCover& cover : covers) {
    double sum = 0.0;
    for (double& fraction : cover.fraction) {
      sum += fraction;
      fraction /= sum;
    }
  }
  return covers;
}

}  // namespace

MapMeans::MapMeans(int lines, int length, int out_lines, int out_length, Way way)
    : way_(way),
      across_(cell_covers(out_lines, lines)),
      along_(cell_covers(out_length, length)),
      line_means_(out_length),
      line_missing_(out_length),
      means_(HeightGrid::Zero(out_lines, out_length)) {
  if (way == Way::sums) return;
  across_ = as_running_parts(std::move(across_));
  along_ = as_running_parts(std::move(along_));
}

void MapMeans::add(const std::vector<double>& line, bool has_gaps) {
  join_along(line, has_gaps);
  if (has_gaps && missing_.size() == 0) missing_ = HeightGrid::Zero(means_.rows(), means_.cols());
  for (std::size_t out = first_open_; out < across_.size() && across_[out].begin <= line_; ++out) {
    const CellCover& cover = across_[out];
    const auto part = static_cast<std::size_t>(line_ - cover.begin);
    if (part >= cover.fraction.size()) {
      first_open_ = out + 1;
      continue;
    }
    const auto row = static_cast<Eigen::Index>(out);
    for (Eigen::Index col = 0; col < means_.cols(); ++col)
      means_(row, col) = joined(means_(row, col), cover.fraction[part], line_means_[col]);
    if (has_gaps) missing_.row(row) += cover.fraction[part] * line_missing_;
  }
  ++line_;
}

void MapMeans::join_along(const std::vector<double>& line, bool has_gaps) {
  for (std::size_t out = 0; out < along_.size(); ++out) {
    const CellCover& cover = along_[out];
    double mean = 0.0, gap = 0.0;
    for (std::size_t k = 0; k < cover.fraction.size(); ++k) {
      const double value = line[static_cast<std::size_t>(cover.begin) + k];
      if (has_gaps && std::isnan(value))
        gap += cover.fraction[k];
      else
        mean = joined(mean, cover.fraction[k], value);
    }
    line_means_[static_cast<Eigen::Index>(out)] = mean;
    line_missing_[static_cast<Eigen::Index>(out)] = gap;
  }
}

HeightGrid running_means(const HeightGrid& values, int rows, int cols) {
  if (values.rows() == rows && values.cols() == cols) return values;
  MapMeans means(static_cast<int>(values.rows()), static_cast<int>(values.cols()), rows, cols,
                 MapMeans::Way::running);
  std::vector<double> line(static_cast<std::size_t>(values.cols()));
  for (Eigen::Index row = 0; row < values.rows(); ++row) {
    for (Eigen::Index col = 0; col < values.cols(); ++col)
      line[static_cast<std::size_t>(col)] = values(row, col);
    means.add(line, false);
  }
  return means.means();
}

}  // namespace sandstroke
