#include "sim/nozzle.h"

#include <algorithm>
#include <cmath>

#include "core/elementary.h"

namespace sandstroke {
namespace {

/// Strips of a cell along x, in each of which the disc's edge is taken as straight up and down. With 16 the
/// part of a cell is within 0.004.
constexpr int strips = 16;

/// The part of a cell that a disc covers; centre and radius in cells.
double covered_part(double col_step, double row_step, double radius) {
  double covered = 0.0;
  for (int strip = 0; strip < strips; ++strip) {
    const double y = row_step - 0.5 + (strip + 0.5) / strips, square = radius * radius - y * y;
    if (square <= 0.0) continue;
    const double half = std::sqrt(square);
    covered += std::max(0.0, std::min(half, col_step + 0.5) - std::max(-half, col_step - 0.5));
  }
  return covered / strips;
}

/// The part of a cell of a square of its size around a point.
double part_around_point(double col_step, double row_step) {
  return std::max(0.0, 1.0 - std::abs(col_step)) * std::max(0.0, 1.0 - std::abs(row_step));
}

std::vector<CellUnder> cells_of(const BedGeometry& bed, double x, double y, double radius) {
  const double in_cells = radius / bed.cell_size(), col = bed.col_at(x), row = bed.row_at(y);
  const bool is_point = in_cells < 0.5;
  const double reach = is_point ? 1.0 : in_cells + 0.5;
  const auto index = [](double cell, int end) {
    return static_cast<int>(std::clamp(cell, 0.0, static_cast<double>(end)));
  };
  const CellRange range{
      index(std::ceil(row - reach), bed.rows()), index(std::floor(row + reach) + 1.0, bed.rows()),
      index(std::ceil(col - reach), bed.cols()), index(std::floor(col + reach) + 1.0, bed.cols())};
  std::vector<CellUnder> cells;
  for (int r = range.row_begin; r < range.row_end; ++r)
    for (int c = range.col_begin; c < range.col_end; ++c) {
      const double part =
          is_point ? part_around_point(c - col, r - row) : covered_part(c - col, r - row, in_cells);
      if (part > 0.0 && bed.has_sand(r, c)) cells.push_back({r, c, part});
    }
  return cells;
}

}  // namespace

Nozzle::Nozzle(const SourceSettings& settings)
    : at_(settings.at), start_(settings.start), stop_(settings.stop) {
  if (!settings.stroke) return;
  path_.emplace(*settings.stroke);
  stop_by(start_ + path_->stroke().duration());
}

std::optional<Eigen::Vector3d> Nozzle::at(double time) {
  if (!path_) return at_;
  const Hand hand = path_->at(path_->start_time() + (time - start_));
  return hand.down ? std::optional<Eigen::Vector3d>(at_ + hand.position) : std::nullopt;
}

std::vector<CellUnder> cells_under_nozzle(const BedGeometry& bed, double x, double y, double radius) {
  std::vector<CellUnder> cells = cells_of(bed, x, y, radius);
  // From far away the way to the edge would take long in steps of a cell.
  x = std::clamp(x, bed.x_of(0), bed.x_of(bed.cols() - 1));
  y = std::clamp(y, bed.y_of(0), bed.y_of(bed.rows() - 1));
  while (cells.empty()) {
    cells = cells_of(bed, x, y, 0.0);
    const double away = elementary::hypot(x, y);
    const double nearer = away > bed.cell_size() ? 1.0 - bed.cell_size() / away : 0.0;
    x *= nearer;
    y *= nearer;
  }
  return cells;
}

}  // namespace sandstroke
