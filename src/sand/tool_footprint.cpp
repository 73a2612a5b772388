#include "sand/tool_footprint.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sandstroke {

double filter::u0() {
  static const double root = std::asin(offset);
  return root;
}

double filter::u1() {
  static const double root = [] {
    double u = 1.2;  // the paper's printed value; Newton's method gives the rest of the digits
    for (int i = 0; i < 8; ++i) u -= (1.0 - std::cos(u) - offset * u) / (std::sin(u) - offset);
    return u;
  }();
  return root;
}

ToolFootprint::ToolFootprint(const ToolSettings& settings)
    : radius_(settings.radius),
      profile_(settings.profile),
      filter_scale_(settings.radius / std::sqrt(filter::u0())),
      amplitude_(settings.radius / (2.0 * filter::u0())),
      reach_(filter_scale_ * std::sqrt(filter::u1())) {}

void ToolFootprint::place(const HeightField& bed, double x, double y) {
  cells_.clear();
  const double dx = bed.cell_size();
  const double tool_row = bed.row_at(y), tool_col = bed.col_at(x);
  const double extent = reach_ / dx + 1.0;  // cells; beyond it the level weight is 0
  if (!(tool_row + extent >= 0.0 && tool_row - extent <= bed.rows() - 1.0)) return;
  if (!(tool_col + extent >= 0.0 && tool_col - extent <= bed.cols() - 1.0)) return;
  const int row_begin = std::max(0, static_cast<int>(std::ceil(tool_row - extent)));
  const int row_end = std::min(bed.rows() - 1, static_cast<int>(std::floor(tool_row + extent)));
  const int col_begin = std::max(0, static_cast<int>(std::ceil(tool_col - extent)));
  const int col_end = std::min(bed.cols() - 1, static_cast<int>(std::floor(tool_col + extent)));

  for (int row = row_begin; row <= row_end; ++row) {
    for (int col = col_begin; col <= col_end; ++col) {
      Cell cell{};
      cell.row = row;
      cell.col = col;
      cell.x = (col - tool_col) * dx;
      cell.y = (row - tool_row) * dx;
      const double rho2 = cell.x * cell.x + cell.y * cell.y;
      const double rho = std::sqrt(rho2);
      cell.level_weight = std::clamp((reach_ - rho) / dx + 1.0, 0.0, 1.0);
      const double u = rho2 / (filter_scale_ * filter_scale_);
      cell.in_bowl = u <= filter::u0();
      cell.in_ring = !cell.in_bowl && u <= filter::u1();
      if (cell.in_bowl) {
        // The root's argument may fall below 0 by rounding at the rim.
        cell.underside = profile_ == ToolProfile::paper
                             ? amplitude_ * std::sin(u)
                             : radius_ - std::sqrt(std::max(0.0, radius_ * radius_ - rho2));
      }
      if (cell.in_ring) cell.rampart = std::max(0.0, std::sin(u) - filter::offset);
      if (cell.level_weight > 0.0 || cell.in_bowl || cell.in_ring) cells_.push_back(cell);
    }
  }
}

double ToolFootprint::sand_level(const HeightField& bed) const {
  double sum = 0.0, weight = 0.0;
  for (const Cell& cell : cells_) {
    sum += cell.level_weight * bed(cell.row, cell.col);
    weight += cell.level_weight;
  }
  return weight > 0.0 ? sum / weight : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace sandstroke
