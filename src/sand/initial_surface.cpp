#include "sand/initial_surface.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sandstroke {
namespace {

/// Area of {0 <= y - y0 <= y1 - y0} under the arc sqrt(r^2 - x^2), for x0 <= x <= x1, all >= 0.
double quadrant_area(double r, double x0, double x1, double y0, double y1) {
  const auto arc_at = [r](double s) { return s < r ? std::sqrt((r - s) * (r + s)) : 0.0; };
  const auto primitive = [&](double x) {
    const double clipped = std::min(x, r);
    return 0.5 * (clipped * arc_at(clipped) + r * r * std::asin(clipped / r));
  };
  const double full_until = std::clamp(arc_at(y1), x0, x1);          // the arc runs above y1
  const double some_until = std::clamp(arc_at(y0), full_until, x1);  // then between y1 and y0, then below y0
  return (full_until - x0) * (y1 - y0) + primitive(some_until) - primitive(full_until) -
         y0 * (some_until - full_until);
}

/// A reproducible number in [-1, 1) for a lattice point (SplitMix64's finaliser).
double lattice_noise(std::int64_t row, std::int64_t col, std::uint32_t seed) {
  std::uint64_t z = static_cast<std::uint64_t>(row) * 0x9e3779b97f4a7c15ULL +
                    static_cast<std::uint64_t>(col) * 0xd1b54a32d192ed03ULL + seed * 0x2545f4914f6cdd1dULL;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
  z ^= z >> 31;
  return static_cast<double>(z >> 11) * 0x1.0p-52 - 1.0;
}

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
      const double rho = std::hypot(x + ((j + 0.5) / n - 0.5) * dx, y + ((i + 0.5) / n - 0.5) * dx);
      sum += std::max(0.0, 1.0 - rho / s.radius);
    }
  return s.height * sum / (n * n);
}

}  // namespace

double disk_cell_area(double radius, double x, double y, double cell_size) {
  // Folded into one octant, so that the area has the symmetries of the square to the bit.
  double far = std::max(std::abs(x), std::abs(y)), near = std::min(std::abs(x), std::abs(y));
  const double half = 0.5 * cell_size;
  const auto span = [half](double centre, double& copies) {
    copies = centre < half ? 2.0 : 1.0;  // a cell across the axis is two mirrored halves
    return centre < half ? 0.0 : centre - half;
  };
  double far_copies, near_copies;
  const double far_begin = span(far, far_copies), near_begin = span(near, near_copies);
  const double far_end = far_copies == 2.0 ? half : far + half,
               near_end = near_copies == 2.0 ? half : near + half;
  return far_copies * near_copies * quadrant_area(radius, far_begin, far_end, near_begin, near_end);
}

HeightField make_surface(const SurfaceSettings& settings, int rows, int cols, double cell_size) {
  HeightField bed(rows, cols, cell_size);
  const auto fill = [&](auto height) {
    for (int row = 0; row < rows; ++row)
      for (int col = 0; col < cols; ++col) bed.set(row, col, height(bed.x_of(col), bed.y_of(row)));
  };
  switch (settings.kind) {
    case SurfaceKind::flat:
    case SurfaceKind::file:
      break;
    case SurfaceKind::cylinder:
      fill([&](double x, double y) {
        return settings.height * (disk_cell_area(settings.radius, x, y, cell_size) / (cell_size * cell_size));
      });
      break;
    case SurfaceKind::cone:
      fill([&](double x, double y) { return cone_average(x, y, cell_size, settings); });
      break;
    case SurfaceKind::cliff:
      fill([&](double x, double) { return settings.height * std::clamp(0.5 - x / cell_size, 0.0, 1.0); });
      break;
    case SurfaceKind::noise:
      fill([&, scale = settings.wavelength > 0.0 ? settings.wavelength : cell_size](double x, double y) {
        if (settings.wavelength > 0.0)
          return settings.amplitude * smooth_noise(y / scale, x / scale, settings.seed);
        return settings.amplitude *
               lattice_noise(std::llround(bed.row_at(y)), std::llround(bed.col_at(x)), settings.seed);
      });
      break;
    case SurfaceKind::ripples: {
      // The mean of a sine over a cell is the sine at its centre, weakened by sinc(pi dx / wavelength).
      const double phase = std::numbers::pi * cell_size / settings.wavelength;
      const double amplitude = settings.amplitude * std::sin(phase) / phase;
      fill([&](double x, double) {
        return amplitude * std::sin(2.0 * std::numbers::pi * x / settings.wavelength);
      });
      break;
    }
  }
  return bed;
}

}  // namespace sandstroke
