#include "render/horizon.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "core/angle.h"

namespace sandstroke {
namespace {

/// Slopes of the horizon towards one direction, for the cells of one rectangle.
class Horizon {
 public:
  Horizon(const DrawnHeights& heights, double cell_size, const CellRange& cells, double ux, double uy)
      : heights_(heights),
        cells_(cells),
        along_x_(std::abs(ux) >= std::abs(uy)),
        sign_((along_x_ ? ux : uy) < 0.0 ? -1 : 1),
        drift_(along_x_ ? uy / std::abs(ux) : ux / std::abs(uy)),
        step_length_(cell_size * std::sqrt(1.0 + drift_ * drift_)),
        slopes_(DrawnHeights::Constant(cells.rows(), cells.cols(), -std::numeric_limits<float>::infinity())) {
  }

  double step_length() const { return step_length_; }
  const DrawnHeights& slopes() const { return slopes_; }

  /// Looks at the heights k cells away along the main axis.
  void look(int k) {
    const double across = k * drift_;
    const int across_cell = static_cast<int>(std::floor(across));
    const auto part = static_cast<float>(across - across_cell);
    const int row_step = along_x_ ? across_cell : sign_ * k, col_step = along_x_ ? sign_ * k : across_cell;
    // The second of the two neighbours across; it is the first where the ray goes through cell centres.
    const int beside = part > 0.0f ? 1 : 0;
    const int row_beside = along_x_ ? beside : 0, col_beside = along_x_ ? 0 : beside;
    const auto rows = static_cast<int>(heights_.rows()), cols = static_cast<int>(heights_.cols());
    const int row_begin = std::max(cells_.row_begin, -row_step);
    const int row_end = std::min(cells_.row_end, rows - row_beside - row_step);
    const int col_begin = std::max(cells_.col_begin, -col_step);
    const int col_count = std::min(cells_.col_end, cols - col_beside - col_step) - col_begin;
    const auto per_length = static_cast<float>(1.0 / (k * step_length_));
    for (int row = row_begin; row < row_end; ++row) {
      const float* here = heights_.row(row).data() + col_begin;
      const float* first = heights_.row(row + row_step).data() + col_begin + col_step;
      const float* second =
          heights_.row(row + row_step + row_beside).data() + col_begin + col_step + col_beside;
      float* slope = slopes_.row(row - cells_.row_begin).data() + col_begin - cells_.col_begin;
      for (int i = 0; i < col_count; ++i) {
        const float far = first[i] + part * (second[i] - first[i]);
        slope[i] = std::max(slope[i], (far - here[i]) * per_length);
      }
    }
  }

 private:
  const DrawnHeights& heights_;
  CellRange cells_;
  bool along_x_;
  int sign_;
  double drift_, step_length_;
  DrawnHeights slopes_;
};

/// Slope of a ray to the lowest point of the sun. Sand below it throws no shadow.
double lowest_ray(const Sun& sun) {
  return std::tan(to_radians(std::max(0.3, sun.elevation - sun.softness)));
}

}  // namespace

Eigen::Vector3d Sun::direction() const {
  const double flat = std::cos(to_radians(elevation));
  return {flat * std::cos(to_radians(azimuth)), flat * std::sin(to_radians(azimuth)),
          std::sin(to_radians(elevation))};
}

int shadow_reach(const Sun& sun, double relief, double cell_size) {
  return static_cast<int>(std::min(1e6, std::ceil(std::max(0.0, relief) / (lowest_ray(sun) * cell_size))));
}

void sun_visibility(const DrawnHeights& heights, double cell_size, const Sun& sun, double highest,
                    const CellRange& cells, DrawnHeights& visible) {
  const auto here = heights.block(cells.row_begin, cells.col_begin, cells.rows(), cells.cols());
  auto seen = visible.block(cells.row_begin, cells.col_begin, cells.rows(), cells.cols());
  Horizon horizon(heights, cell_size, cells, std::cos(to_radians(sun.azimuth)),
                  std::sin(to_radians(sun.azimuth)));
  const int reach =
      std::min(shadow_reach(sun, highest - static_cast<double>(here.minCoeff()), horizon.step_length()),
               static_cast<int>(std::max(heights.rows(), heights.cols())));
  for (int k = 1; k <= reach; ++k) horizon.look(k);

  // A penumbra whose middle, in slope, is the sun's own elevation.
  const double sun_slope = std::tan(to_radians(std::min(sun.elevation, 89.0)));
  const double half_width = sun_slope - std::min(lowest_ray(sun), 0.999 * sun_slope);
  const auto first = static_cast<float>(sun_slope - half_width), width = static_cast<float>(2.0 * half_width);
  seen = ((horizon.slopes() - first) / width).max(0.0f).min(1.0f);
  seen = 1.0f - seen * seen * (3.0f - 2.0f * seen);
}

void sky_visibility(const DrawnHeights& heights, double cell_size, const CellRange& cells,
                    DrawnHeights& visible) {
  constexpr std::array<int, 7> distances = {1, 2, 3, 5, 8, 12, sky_reach};
  auto seen = visible.block(cells.row_begin, cells.col_begin, cells.rows(), cells.cols());
  seen.setZero();
  for (const auto& [ux, uy] :
       {std::pair{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}}) {
    Horizon horizon(heights, cell_size, cells, ux, uy);
    for (const int k : distances) horizon.look(k);
    const auto slope = horizon.slopes().max(0.0f);
    seen += 0.125f * (1.0f - slope / (1.0f + slope * slope).sqrt());
  }
}

}  // namespace sandstroke
