#include "sand/upper_side.h"

#include <algorithm>
#include <cmath>

#include "core/elementary.h"
#include "core/error.h"
#include "rules/force.h"
#include "sand/cells_around.h"
#include "tool/tool_surface.h"
#include "tool/triangle_samples.h"

namespace sandstroke {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// The grid reaches as far as any turn may take the tool.
BedGeometry grid_around(const TriangleMesh& surface, double cell_size) {
  double farthest = 0.0;
  for (const Vector3d& vertex : surface.vertices) farthest = std::max(farthest, length_of(vertex));
  constexpr double most_cells = 2000.0;  // along a side
  const double half = std::ceil(farthest / cell_size) + UpperSide::margin;
  if (!(2.0 * half <= most_cells))
    throw_input_error(
        "tool.carries: the tool reaches {:.3g} m from its tip, which are {:.0f} cells; take a smaller "
        "tool or fewer bed.cells",
        farthest, half);
  return {static_cast<int>(2.0 * half), static_cast<int>(2.0 * half), cell_size};
}

/// Error: input, where sand could lie under a part of a closed surface that hangs over another part.
void check_no_overhang(const TriangleMesh& surface, const BedGeometry& grid) {
  struct Crossing {
    double z;
    int enters;  // 1: upwards into the body, -1: out of it
  };
  std::vector<std::vector<Crossing>> crossings(static_cast<std::size_t>(grid.rows()) * grid.cols());
  // Off the middles of cells, so that hardly any line meets an edge.
  const Vector3d aside(0.3183e-3 * grid.cell_size(), 0.2718e-3 * grid.cell_size(), 0.0),
      first(grid.x_of(0), grid.y_of(0), 0.0);
  for (std::size_t i = 0; i < surface.triangles.size(); ++i) {
    const Vector3d a = surface.corner(i, 0) - first - aside, b = surface.corner(i, 1) - first - aside,
                   c = surface.corner(i, 2) - first - aside;
    const double area = (b - a).head<2>().x() * (c - a).y() - (b - a).y() * (c - a).x();
    visit_triangle_samples(a, b, c, 1.0 / grid.cell_size(), [&](int col, int row, double z) {
      crossings[static_cast<std::size_t>(row) * grid.cols() + col].push_back({z, area < 0.0 ? 1 : -1});
    });
  }
  const double least_gap = 1e-6 * grid.cell_size() * grid.cols();
  for (int row = 0; row < grid.rows(); ++row)
    for (int col = 0; col < grid.cols(); ++col) {
      auto& line = crossings[static_cast<std::size_t>(row) * grid.cols() + col];
      std::sort(line.begin(), line.end(),
                [](const Crossing& one, const Crossing& other) { return one.z < other.z; });
      int inside = 0;
      for (std::size_t i = 0; i + 1 < line.size(); ++i) {
        inside += line[i].enters;
        if (inside != 0 || line[i + 1].z - line[i].z <= least_gap) continue;
        throw_input_error(
            "tool.carries: the tool's upper side is no height field: {:.3g} m above its tip, at "
            "x = {:.3g} m, y = {:.3g} m from it, a part hangs over another part, where sand could lie in "
            "between; turn it by tool.orientation, take another shape, or remove tool.carries",
            line[i + 1].z, grid.x_of(col), grid.y_of(row));
      }
    }
}

}  // namespace

UpperSide::UpperSide(const TriangleMesh& surface, double cell_size)
    : surface_(surface), grid_(grid_around(surface, cell_size)) {
  check_no_overhang(surface_, grid_);
  own_top_ = highest_points(surface_);
}

HeightGrid UpperSide::highest_points(const TriangleMesh& surface) const {
  HeightGrid top = HeightGrid::Constant(grid_.rows(), grid_.cols(), nowhere);
  const Vector3d first(grid_.x_of(0), grid_.y_of(0), 0.0);
  for (std::size_t i = 0; i < surface.triangles.size(); ++i)
    visit_triangle_samples(surface.corner(i, 0) - first, surface.corner(i, 1) - first,
                           surface.corner(i, 2) - first, 1.0 / grid_.cell_size(),
                           [&](int col, int row, double z) { top(row, col) = std::max(top(row, col), z); });
  return top;
}

void UpperSide::turn(const Eigen::Matrix3d& hand) {
  const double length = elementary::hypot(hand(0, 0), hand(1, 0));
  constexpr double upright = 1e-6;  // the tool's x axis: it has no direction from above
  if (length > upright) {
    cos_ = hand(0, 0) / length;
    sin_ = hand(1, 0) / length;
  }
  Eigen::Matrix3d back = Eigen::Matrix3d::Identity();
  back.topLeftCorner<2, 2>() << cos_, sin_, -sin_, cos_;
  const Eigen::Matrix3d tilt = back * hand;
  constexpr double rounding = 1e-12;
  const bool tilts = (tilt - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() > rounding;
  if (tilts && (!tilted_ || (tilt - tilt_).cwiseAbs().maxCoeff() > rounding)) {
    tilt_ = tilt;
    ++tilts_;
    tilted_top_ = highest_points(sandstroke::turned(surface_, tilt));
    double& on_axis = tilted_top_(grid_.rows() / 2, grid_.cols() / 2);
    if ((tilted_top_ == nowhere).all()) on_axis = 0.0;  // an edge between the middles of cells
  }
  tilted_ = tilts;
}

Vector3d UpperSide::turned(const Vector3d& own) const {
  const Vector3d tilted = tilted_ ? Vector3d(tilt_ * own) : own;
  const Vector2d level = in_bed(tilted.head<2>());
  return {level.x(), level.y(), tilted.z()};
}

UpperSide::Cell UpperSide::cell_at(const Vector2d& in_grid) const {
  constexpr int reach = 2;
  const double col_at = grid_.col_at(in_grid.x()), row_at = grid_.row_at(in_grid.y());
  const int row = static_cast<int>(std::lround(row_at)), col = static_cast<int>(std::lround(col_at));
  Cell found{-1, -1};
  double least = std::numeric_limits<double>::infinity();
  for (int r = std::max(row - reach, 0); r <= std::min(row + reach, grid_.rows() - 1); ++r)
    for (int c = std::max(col - reach, 0); c <= std::min(col + reach, grid_.cols() - 1); ++c) {
      const double far = (r - row_at) * (r - row_at) + (c - col_at) * (c - col_at);
      if (!covers(r, c) || far >= least) continue;
      least = far;
      found = {r, c};
    }
  return found;
}

/// The covered cell that is nearest in space.
UpperSide::Cell UpperSide::nearest(const Vector2d& place, double height) const {
  Cell found{-1, -1};
  const int at_row = static_cast<int>(std::lround(grid_.row_at(place.y()))),
            at_col = static_cast<int>(std::lround(grid_.col_at(place.x())));
  for (int reach = 4; found.row < 0; reach *= 4) found = nearest_within(reach, at_row, at_col, place, height);
  return found;
}

UpperSide::Cell UpperSide::nearest_within(int reach, int at_row, int at_col, const Vector2d& place,
                                          double height) const {
  Cell found{-1, -1};
  double least = std::numeric_limits<double>::infinity();
  for (int row = std::max(at_row - reach, 0); row <= std::min(at_row + reach, grid_.rows() - 1); ++row)
    for (int col = std::max(at_col - reach, 0); col <= std::min(at_col + reach, grid_.cols() - 1); ++col) {
      if (!covers(row, col)) continue;
      const double far = (Vector3d(grid_.x_of(col), grid_.y_of(row), top()(row, col)) -
                          Vector3d(place.x(), place.y(), height))
                             .squaredNorm();
      if (far >= least) continue;
      least = far;
      found = {row, col};
    }
  return found;
}

UpperSide::Parts UpperSide::parts_at(const Vector2d& in_grid, double height) const {
  // What is as steep as this is no wall.
  const double steepness =
      tilted_ ? std::sqrt(std::max(1.0 - tilt_(2, 2) * tilt_(2, 2), 0.0)) / std::max(tilt_(2, 2), 0.1) : 0.0;
  const double level = 1.5 * (1.0 + steepness) * grid_.cell_size();
  Parts parts;
  double whole = 0.0;
  visit_cells_around(grid_.row_at(in_grid.y()), grid_.col_at(in_grid.x()),
                     [&](int row, int col, double part) {
                       if (row < 0 || row >= grid_.rows() || col < 0 || col >= grid_.cols() ||
                           !(std::abs(top()(row, col) - height) <= level))
                         return;
                       parts.of[static_cast<std::size_t>(parts.count++)] = {row * grid_.cols() + col, part};
                       whole += part;
                     });
  if (parts.count == 0) {
    const Cell cell = nearest(in_grid, height);
    parts.of[0] = {cell.row * grid_.cols() + cell.col, 1.0};
    parts.count = 1;
    whole = 1.0;
  }
  for (int i = 0; i < parts.count; ++i) parts.of[static_cast<std::size_t>(i)].part /= whole;
  return parts;
}

std::vector<UpperSide::Share> UpperSide::shares() const {
  std::vector<Share> shares;
  // Columns lie over fewer cells than before. Each is taken in four parts, whose sand goes to the four cells
  // around them: what is even stays even within 1 %.
  std::vector<Part> cells;
  const auto add = [&](const Part& one) {
    for (Part& known : cells)
      if (known.cell == one.cell) {
        known.part += 0.25 * one.part;
        return;
      }
    cells.push_back({one.cell, 0.25 * one.part});
  };
  for (int row = 0; row < grid_.rows(); ++row)
    for (int col = 0; col < grid_.cols(); ++col) {
      const double z = own_top_(row, col);
      if (z == nowhere) continue;
      cells.clear();
      for (const double down : {-0.25, 0.25})
        for (const double left : {-0.25, 0.25}) {
          const Vector3d place = tilt_ * Vector3d(grid_.x_of(col) + left * grid_.cell_size(),
                                                  grid_.y_of(row) + down * grid_.cell_size(), z);
          const Parts parts = parts_at(place.head<2>(), place.z());
          for (int i = 0; i < parts.count; ++i) add(parts.of[static_cast<std::size_t>(i)]);
        }
      for (const Part& one : cells) shares.push_back({row * grid_.cols() + col, one.cell, one.part});
    }
  return shares;
}

}  // namespace sandstroke
