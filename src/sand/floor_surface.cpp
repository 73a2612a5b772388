#include "sand/floor_surface.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace sandstroke {
namespace {

using Point = Eigen::Vector3d;

/// The point of a triangle that is nearest to p (Ericson, Real-Time Collision Detection, 5.1.5).
Point nearest_in_triangle(const Point& p, const Point& a, const Point& b, const Point& c) {
  const Point ab = b - a, ac = c - a, ap = p - a, bp = p - b, cp = p - c;
  const double d1 = ab.dot(ap), d2 = ac.dot(ap), d3 = ab.dot(bp), d4 = ac.dot(bp), d5 = ab.dot(cp),
               d6 = ac.dot(cp);
  if (d1 <= 0.0 && d2 <= 0.0) return a;
  if (d3 >= 0.0 && d4 <= d3) return b;
  if (d6 >= 0.0 && d5 <= d6) return c;
  const double vc = d1 * d4 - d3 * d2, vb = d5 * d2 - d1 * d6, va = d3 * d6 - d5 * d4;
  if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) return a + d1 / (d1 - d3) * ab;
  if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) return a + d2 / (d2 - d6) * ac;
  if (va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0) return b + (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (c - b);
  const double whole = va + vb + vc;
  return a + vb / whole * ab + vc / whole * ac;
}

/// How far x is outside [low, high].
double beyond(double x, double low, double high) { return std::max({low - x, x - high, 0.0}); }

}  // namespace

/// The nearest point found so far.
struct FloorSurface::Search {
  Point from, nearest;
  double square;  // of the distance [m^2]

  void take(const Point& point) {
    const double far = (point - from).squaredNorm();
    if (!(far < square)) return;
    square = far;
    nearest = point;
  }
};

bool FloorSurface::open(const HeightField& floor, double x, double y, double reach, double height) {
  constexpr int side = BedGeometry::tile_side;
  cell_ = floor.cell_size();
  rows_ = cols_ = 0;
  level_ = floor.untouched().highest();
  const double left = floor.col_at(x - reach), right = floor.col_at(x + reach),
               down = floor.row_at(y - reach), up = floor.row_at(y + reach);
  if (!(right > -1.0 && up > -1.0 && left < floor.cols() && down < floor.rows())) return false;
  const int first_row = static_cast<int>(std::floor(down)), first_col = static_cast<int>(std::floor(left)),
            end_row = static_cast<int>(std::floor(up)) + 2, end_col = static_cast<int>(std::floor(right)) + 2;
  const auto row_in = [&](int row) { return std::clamp(row, 0, floor.rows() - 1); };
  const auto col_in = [&](int col) { return std::clamp(col, 0, floor.cols() - 1); };
  bool is_level = true;
  for (int i = row_in(first_row) / side; i <= row_in(end_row - 1) / side; ++i)
    for (int j = col_in(first_col) / side; j <= col_in(end_col - 1) / side; ++j)
      is_level = is_level && floor.slot_of(floor.tile_index(i, j)) < 0;
  if (is_level) return level_ > height;
  rows_ = end_row - first_row;
  cols_ = end_col - first_col;
  first_x_ = (floor.cols_from_centre(0) + first_col) * cell_;
  first_y_ = (floor.rows_from_centre(0) + first_row) * cell_;
  heights_.resize(static_cast<std::size_t>(rows_) * cols_);
  double highest = -std::numeric_limits<double>::infinity();
  for (int row = 0; row < rows_; ++row)
    for (int col = 0; col < cols_; ++col) {
      const double here = floor(row_in(first_row + row), col_in(first_col + col));
      heights_[static_cast<std::size_t>(row) * cols_ + col] = here;
      highest = std::max(highest, here);
    }
  return highest > height;
}

bool FloorSurface::has_step(int row, int col) const {
  const auto [low, high] =
      std::minmax({at(row, col), at(row, col + 1), at(row + 1, col), at(row + 1, col + 1)});
  return !(high - low <= step * cell_);
}

double FloorSurface::height(double x, double y) const {
  return rows_ == 0 ? level_ : height_at(x - first_x_, y - first_y_);
}

double FloorSurface::height_at(double x, double y) const {
  const double in_cols = std::clamp(x / cell_, 0.0, cols_ - 1.0),
               in_rows = std::clamp(y / cell_, 0.0, rows_ - 1.0);
  const int col = std::min(static_cast<int>(in_cols), cols_ - 2),
            row = std::min(static_cast<int>(in_rows), rows_ - 2);
  const double u = in_cols - col, v = in_rows - row;
  if (has_step(row, col)) return at(row + (v >= 0.5), col + (u >= 0.5));
  const double a = at(row, col), b = at(row, col + 1), c = at(row + 1, col), e = at(row + 1, col + 1),
               middle = 0.25 * ((a + e) + (b + c));
  // In each of the triangles: from the middle of their edge towards the mean, and along the edge.
  const auto in_triangle = [&](double from, double to, double along, double off) {
    return from + along * (to - from) + 2.0 * off * (middle - 0.5 * (from + to));
  };
  const double least_u = std::min(u, 1.0 - u), least_v = std::min(v, 1.0 - v);
  if (least_v <= least_u) return v < 0.5 ? in_triangle(a, b, u, v) : in_triangle(c, e, u, 1.0 - v);
  return u < 0.5 ? in_triangle(a, c, v, u) : in_triangle(b, e, v, 1.0 - u);
}

void FloorSurface::look_at_triangles(int row, int col, Search& search) const {
  const double x = col * cell_, y = row * cell_;
  const std::array<Point, 4> corners = {Point(x, y, at(row, col)), Point(x + cell_, y, at(row, col + 1)),
                                        Point(x + cell_, y + cell_, at(row + 1, col + 1)),
                                        Point(x, y + cell_, at(row + 1, col))};
  const Point middle(x + 0.5 * cell_, y + 0.5 * cell_,
                     0.25 * ((corners[0].z() + corners[2].z()) + (corners[1].z() + corners[3].z())));
  for (std::size_t i = 0; i < 4; ++i)
    search.take(nearest_in_triangle(search.from, corners[i], corners[(i + 1) % 4], middle));
}

void FloorSurface::look_at_steps(int row, int col, Search& search) const {
  const double x = col * cell_, y = row * cell_, half = 0.5 * cell_;
  const Point& from = search.from;
  for (int i = 0; i < 2; ++i) {
    const double near_y = std::clamp(from.y(), y + i * half, y + (i + 1) * half),
                 near_x = std::clamp(from.x(), x + i * half, x + (i + 1) * half);
    for (int j = 0; j < 2; ++j)
      if (std::isfinite(at(row + i, col + j)))
        search.take({std::clamp(from.x(), x + j * half, x + (j + 1) * half), near_y, at(row + i, col + j)});
    const auto side = [&](double one, double other, double at_x, double at_y) {
      if (one != other)
        search.take({at_x, at_y, std::clamp(from.z(), std::min(one, other), std::max(one, other))});
    };
    side(at(row + i, col), at(row + i, col + 1), x + half, near_y);
    side(at(row, col + i), at(row + 1, col + i), near_x, y + half);
  }
}

FloorSurface::Side FloorSurface::nearest(const Eigen::Vector3d& point, double most) const {
  const Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
  if (rows_ == 0) return {std::min(point.z() - level_, most), up};
  Search search{local(point), Point::Zero(), most * most};
  const double x = search.from.x(), y = search.from.y(), z = search.from.z(), below = height_at(x, y);
  const bool inside = z < below;
  if (inside) search.square = std::numeric_limits<double>::infinity();
  const double at_most = search.square;
  if (std::isfinite(below)) search.take({x, y, below});
  const auto range = [&](double centre, double reach, int count) {
    return std::pair(std::max(0, static_cast<int>(std::floor((centre - reach) / cell_))),
                     std::min(count - 2, static_cast<int>(std::floor((centre + reach) / cell_))));
  };
  const double reach = std::min(std::sqrt(search.square), cell_ * (rows_ + cols_));
  const auto rows = range(y, reach, rows_), cols = range(x, reach, cols_);
  for (int row = rows.first; row <= rows.second; ++row)
    for (int col = cols.first; col <= cols.second; ++col) {
      const double a = at(row, col), b = at(row, col + 1), c = at(row + 1, col), e = at(row + 1, col + 1);
      const auto [low, high] = std::minmax({a, b, c, e});
      const double off_x = beyond(x, col * cell_, (col + 1) * cell_),
                   off_y = beyond(y, row * cell_, (row + 1) * cell_), off_z = beyond(z, low, high);
      if (!(off_x * off_x + off_y * off_y + off_z * off_z < search.square)) continue;
      if (high - low <= step * cell_)
        look_at_triangles(row, col, search);
      else
        look_at_steps(row, col, search);
    }
  if (search.square == at_most) return {most, up};
  const double far = std::sqrt(search.square);
  if (!(far > 0.0)) return {0.0, up};
  return {inside ? -far : far, (inside ? 1.0 : -1.0) / far * (search.nearest - search.from)};
}

}  // namespace sandstroke
