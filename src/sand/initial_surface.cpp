#include "sand/initial_surface.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "core/elementary.h"
#include "core/hash.h"

namespace sandstroke {
namespace {

/// Area between y0 and y1 under the arc sqrt(r^2 - x^2), for x0 <= x <= x1; all are >= 0.
double quadrant_area(double r, double x0, double x1, double y0, double y1) {
  const auto arc_at = [r](double s) { return s < r ? std::sqrt((r - s) * (r + s)) : 0.0; };
  const auto primitive = [&](double x) {
    const double clipped = std::min(x, r);
    return 0.5 * (clipped * arc_at(clipped) + r * r * elementary::asin(clipped / r));
  };
  const double full_until = std::clamp(arc_at(y1), x0, x1);          // the arc runs above y1
  const double some_until = std::clamp(arc_at(y0), full_until, x1);  // then between y1 and y0, then below y0
  if (some_until == full_until) return (full_until - x0) * (y1 - y0);  // most cells: no arc in them
  return (full_until - x0) * (y1 - y0) + primitive(some_until) - primitive(full_until) -
         y0 * (some_until - full_until);
}

/// A reproducible number in [-1, 1) for a lattice point.
double lattice_noise(std::int64_t row, std::int64_t col, std::uint32_t seed) {
  return 2.0 * unit_hash(static_cast<std::uint64_t>(row) * 0x9e3779b97f4a7c15ULL +
                         static_cast<std::uint64_t>(col) * 0xd1b54a32d192ed03ULL +
                         seed * 0x2545f4914f6cdd1dULL) -
         1.0;
}

/// The steepest rise of smooth_noise between lattice points that differ by 1: t^3 (6 t^2 - 15 t + 10) at 1/2.
constexpr double steepest_fade = 1.875;

/// Lattice noise joined smoothly between points one unit apart.
double smooth_noise(double row, double col, std::uint32_t seed) {
  const double r0 = std::floor(row), c0 = std::floor(col);
  const auto fade = [](double t) { return t * t * t * (t * (t * 6.0 - 15.0) + 10.0); };
  const double fr = fade(row - r0), fc = fade(col - c0);
  const auto at = [&](int dr, int dc) {
    return lattice_noise(static_cast<std::int64_t>(r0) + dr, static_cast<std::int64_t>(c0) + dc, seed);
  };
  return std::lerp(std::lerp(at(0, 0), at(0, 1), fc), std::lerp(at(1, 0), at(1, 1), fc), fr);
}

double cone_average(double x, double y, double dx, const SurfaceSettings& s) {
  constexpr int n = 8;
  double sum = 0.0;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const double rho = elementary::hypot(x + ((j + 0.5) / n - 0.5) * dx, y + ((i + 0.5) / n - 0.5) * dx);
      sum += std::max(0.0, 1.0 - rho / s.radius);
    }
  return s.height * sum / (n * n);
}

constexpr double any_slope = std::numeric_limits<double>::infinity();

/// Least and largest distance [m] of cell centres in a range from the z axis.
std::pair<double, double> distances(const BedGeometry& bed, const CellRange& cells) {
  const auto along = [](double first, double last) {
    const double least = first > 0.0 ? first : std::max(0.0, -last);
    return std::pair(least, std::max(std::abs(first), std::abs(last)));
  };
  const auto [near_x, far_x] = along(bed.x_of(cells.col_begin), bed.x_of(cells.col_end - 1));
  const auto [near_y, far_y] = along(bed.y_of(cells.row_begin), bed.y_of(cells.row_end - 1));
  return {elementary::hypot(near_x, near_y), elementary::hypot(far_x, far_y)};
}

/// A rule made of height(x, y) [m] at a cell's centre and a bound of the slope over a range.
template <class Height, class Steepest>
class FormulaRule : public SurfaceRule {
 public:
  FormulaRule(Height height, Steepest steepest, double highest)
      : height_(height), steepest_(steepest), highest_(highest) {}
  void fill(const BedGeometry& bed, const CellRange& cells, double* out,
            std::ptrdiff_t stride) const override {
    for (int row = cells.row_begin; row < cells.row_end; ++row, out += stride)
      for (int col = cells.col_begin; col < cells.col_end; ++col)
        out[col - cells.col_begin] =
            height_(bed.x_of(col), bed.y_of(row)) + 0.0;  // no -0.0: equal heights have the same bits
  }
  double steepest(const BedGeometry& bed, const CellRange& cells) const override {
    return steepest_(bed, cells);
  }
  double highest() const override { return highest_; }

 private:
  Height height_;
  Steepest steepest_;
  double highest_;
};

/// The steepest slope of a rule: the same everywhere.
auto everywhere(double slope) {
  return [slope](const BedGeometry&, const CellRange&) { return slope; };
}

/// A slope bound by the distance of a range's cells from the z axis, to within a cell: 0 beyond the radius,
/// `inside` within it, else `at_the_rim`.
auto slope_by_distance(double inside, double at_the_rim, double radius) {
  return [=](const BedGeometry& b, const CellRange& cells) {
    const auto [nearest, farthest] = distances(b, cells);
    if (nearest >= radius + b.cell_size()) return 0.0;
    return farthest <= radius - b.cell_size() ? inside : at_the_rim;
  };
}

}  // namespace

double disk_cell_area(double radius, double x, double y, double cell_size) {
  // Folds the cell into one octant, so that the area has the symmetries of the square to the bit.
  struct Span {
    double begin, end, copies;
  };
  const auto span_about = [half = 0.5 * cell_size](double centre) -> Span {
    if (centre < half) return {0.0, half, 2.0};  // a cell across the axis is two mirrored halves
    return {centre - half, centre + half, 1.0};
  };
  const Span far = span_about(std::max(std::abs(x), std::abs(y))),
             near = span_about(std::min(std::abs(x), std::abs(y)));
  return far.copies * near.copies * quadrant_area(radius, far.begin, far.end, near.begin, near.end);
}

double disk_rectangle_area(double radius, double x0, double x1, double y0, double y1) {
  // Each quadrant has its part of the rectangle, mirrored into the first one.
  double area = 0.0;
  for (const double right : {1.0, -1.0})
    for (const double up : {1.0, -1.0}) {
      const double begin_x = std::max(0.0, std::min(right * x0, right * x1)),
                   end_x = std::max(right * x0, right * x1),
                   begin_y = std::max(0.0, std::min(up * y0, up * y1)), end_y = std::max(up * y0, up * y1);
      if (begin_x < end_x && begin_y < end_y) area += quadrant_area(radius, begin_x, end_x, begin_y, end_y);
    }
  return area;
}

HeightField make_surface(const SurfaceSettings& settings, int rows, int cols, double cell_size,
                         BedShape shape) {
  const BedGeometry bed(rows, cols, cell_size);
  const auto with = [&](auto height, auto steepest, double highest) {
    return HeightField(
        rows, cols, cell_size,
        std::make_shared<FormulaRule<decltype(height), decltype(steepest)>>(height, steepest, highest),
        shape);
  };
  const SurfaceSettings s = settings;  // the rules capture this copy by value
  switch (s.kind) {
    case SurfaceKind::flat:
    case SurfaceKind::file:
      break;
    case SurfaceKind::cylinder:
      return with(
          [=](double x, double y) {
            return s.height * (disk_cell_area(s.radius, x, y, cell_size) / (cell_size * cell_size));
          },
          slope_by_distance(1e-9, any_slope, s.radius),
          std::max(0.0, s.height));  // 1e-9: heights inside differ by rounding only
    case SurfaceKind::cone: {
      const double slope = std::abs(s.height) / s.radius;
      return with([=](double x, double y) { return cone_average(x, y, cell_size, s); },
                  slope_by_distance(slope, slope, s.radius), std::max(0.0, s.height));
    }
    case SurfaceKind::cliff:
      return with([=](double x, double) { return s.height * std::clamp(0.5 - x / cell_size, 0.0, 1.0); },
                  [](const BedGeometry& b, const CellRange& cells) {
                    const double first = b.x_of(cells.col_begin), last = b.x_of(cells.col_end - 1);
                    return first >= b.cell_size() || last <= -b.cell_size() ? 0.0 : any_slope;
                  },
                  std::max(0.0, s.height));
    case SurfaceKind::noise:
      if (s.wavelength > 0.0)
        return with(
            [=](double x, double y) {
              return s.amplitude * smooth_noise(y / s.wavelength, x / s.wavelength, s.seed);
            },
            everywhere(steepest_fade * std::numbers::sqrt2 * 2.0 * s.amplitude / s.wavelength), s.amplitude);
      return with(
          [=](double x, double y) {
            return s.amplitude *
                   lattice_noise(std::llround(bed.row_at(y)), std::llround(bed.col_at(x)), s.seed);
          },
          everywhere(std::numbers::sqrt2 * 2.0 * s.amplitude / cell_size), s.amplitude);
    case SurfaceKind::ripples: {
      // The mean of a sine over a cell is the sine at its centre, weakened by sinc(pi dx / wavelength).
      const double phase = std::numbers::pi * cell_size / s.wavelength;
      const double amplitude = s.amplitude * elementary::sin(phase) / phase;
      return with(
          [=](double x, double) {
            return amplitude * elementary::sin(2.0 * std::numbers::pi * x / s.wavelength);
          },
          everywhere(2.0 * std::numbers::pi * s.amplitude / s.wavelength), s.amplitude);
    }
  }
  return HeightField(rows, cols, cell_size, shape);
}

}  // namespace sandstroke
