#include "sand/room_on_tool.h"

#include <cmath>
#include <numbers>
#include <queue>

namespace sandstroke {
namespace {

using Eigen::Vector3d;

/// The volume under the highest surface that is nowhere steeper than the slope, towards eight neighbours, and
/// that sand cannot leave over the rim. It rises from the rim inwards, its lowest cell first.
double largest_heap(const HeightGrid& top, double cell_size, double slope) {
  struct Reached {
    double height;
    int row, col;
    bool operator<(const Reached& other) const { return height > other.height; }  // the lowest is on top
  };
  const int rows = static_cast<int>(top.rows()), cols = static_cast<int>(top.cols());
  HeightGrid heap = HeightGrid::Constant(rows, cols, std::numeric_limits<double>::infinity());
  std::priority_queue<Reached> front;
  const auto reach = [&](int row, int col, double height) {
    if (!(height < heap(row, col))) return;
    heap(row, col) = height;
    front.push({height, row, col});
  };
  for (int row = 0; row < rows; ++row)
    for (int col = 0; col < cols; ++col)
      if (top(row, col) == UpperSide::nowhere) reach(row, col, UpperSide::nowhere);
  while (!front.empty()) {
    const Reached here = front.top();
    front.pop();
    if (here.height > heap(here.row, here.col)) continue;
    for (int row = std::max(here.row - 1, 0); row <= std::min(here.row + 1, rows - 1); ++row)
      for (int col = std::max(here.col - 1, 0); col <= std::min(here.col + 1, cols - 1); ++col) {
        const bool is_diagonal = row != here.row && col != here.col;
        const double way = cell_size * (is_diagonal ? std::numbers::sqrt2 : 1.0);
        // Nothing runs between two cells of a wall that touch with their corners.
        const double pass = std::min(top(row, here.col), top(here.row, col));
        reach(row, col, std::max({top(row, col), here.height + slope * way, pass}));
      }
  }
  double volume = 0.0;
  for (int row = 0; row < rows; ++row)
    for (int col = 0; col < cols; ++col)
      if (top(row, col) != UpperSide::nowhere) volume += heap(row, col) - top(row, col);
  return volume * cell_size * cell_size;
}

}  // namespace

RoomOnTool room_on_tool(const UpperSide& upper, const TriangleMesh& surface, double slope) {
  const double cell_size = upper.grid().cell_size();
  HeightGrid raised = upper.top();
  for (std::size_t i = 0; i < surface.triangles.size(); ++i)
    for (const int corner : {0, 1, 2}) {
      const Vector3d from = surface.corner(i, corner), way = surface.corner(i, (corner + 1) % 3) - from;
      const int steps = 1 + static_cast<int>(4.0 * way.head<2>().norm() / cell_size);
      for (int step = 0; step <= steps; ++step) {
        const Vector3d place = from + way * (static_cast<double>(step) / steps);
        const UpperSide::Cell cell = upper.cell_at(upper.in_grid(place.head<2>()));
        if (cell.row >= 0) raised(cell.row, cell.col) = std::max(raised(cell.row, cell.col), place.z());
      }
    }
  return {largest_heap(upper.top(), cell_size, slope), largest_heap(raised, cell_size, slope)};
}

}  // namespace sandstroke
