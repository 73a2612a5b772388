#include "sand/stone_surface.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/angle.h"
#include "core/elementary.h"

namespace sandstroke {
namespace {

constexpr double no_stone = -std::numeric_limits<double>::infinity();
constexpr int samples_across = 7;  // odd: the middle one is the centre
constexpr int samples_of_cell = samples_across * samples_across;

/// The way of a sample from its cell's centre [cells].
double sample_offset(int sample) {
  return (sample - samples_across / 2) / static_cast<double>(samples_across);
}

/// Of a triangle seen from above [m^2]: above 0 if it faces up.
double doubled_area(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

}  // namespace

StoneSurface::StoneSurface(const StoneSettings& stone)
    : stone_(stone),
      cos_(elementary::cos(to_radians(stone.turn))),
      sin_(elementary::sin(to_radians(stone.turn))) {
  const auto place = [&](const Eigen::Vector3d& own) {
    return Eigen::Vector3d(stone.centre + Eigen::Vector3d(cos_ * own.x() - sin_ * own.y(),
                                                          sin_ * own.x() + cos_ * own.y(), own.z()));
  };
  switch (stone.shape) {
    case StoneShape::sphere: {
      const Eigen::Vector3d half = Eigen::Vector3d::Constant(stone.radius);
      bounds_ = {stone.centre - half, stone.centre + half};
      return;
    }
    case StoneShape::ellipsoid:
    case StoneShape::box:
      for (const double x : {-0.5, 0.5})
        for (const double y : {-0.5, 0.5})
          for (const double z : {-0.5, 0.5})
            bounds_.extend(place(stone.size.cwiseProduct(Eigen::Vector3d(x, y, z))));
      return;
    case StoneShape::mesh:
      for (const Eigen::Vector3d& vertex : stone.mesh->vertices) {
        corners_.push_back(place(vertex));
        bounds_.extend(corners_.back());
      }
      sort_into_bands();
      return;
  }
}

void StoneSurface::sort_into_bands() {
  constexpr std::size_t bands = 64;
  bands_.resize(bands);
  for (std::size_t i = 0; i < stone_.mesh->triangles.size(); ++i) {
    const auto& [first, second, third] = stone_.mesh->triangles[i];
    const Eigen::Vector3d &a = corners_[static_cast<std::size_t>(first)],
                          &b = corners_[static_cast<std::size_t>(second)],
                          &c = corners_[static_cast<std::size_t>(third)];
    if (!(doubled_area(a, b, c) > 0.0)) continue;  // it faces down, or is seen from its edge
    const std::size_t last = band_at(std::max({a.y(), b.y(), c.y()}));
    for (std::size_t band = band_at(std::min({a.y(), b.y(), c.y()})); band <= last; ++band)
      bands_[band].push_back(static_cast<std::int32_t>(i));
  }
}

std::size_t StoneSurface::band_at(double y) const {
  const double share = (y - bounds_.min().y()) / bounds_.sizes().y(),
               last = static_cast<double>(bands_.size() - 1);
  return static_cast<std::size_t>(std::clamp(share * (last + 1.0), 0.0, last));
}

double StoneSurface::height(double x, double y) const {
  const double from_x = x - stone_.centre.x(), from_y = y - stone_.centre.y();
  const double u = cos_ * from_x + sin_ * from_y, v = cos_ * from_y - sin_ * from_x;
  const Eigen::Vector3d half = stone_.shape == StoneShape::sphere ? Eigen::Vector3d::Constant(stone_.radius)
                                                                  : Eigen::Vector3d(0.5 * stone_.size);
  if (stone_.shape == StoneShape::box)
    return std::abs(u) <= half.x() && std::abs(v) <= half.y() ? stone_.centre.z() + half.z() : no_stone;
  const double p = u / half.x(), q = v / half.y(), rest = 1.0 - p * p - q * q;
  return rest >= 0.0 ? stone_.centre.z() + half.z() * std::sqrt(rest) : no_stone;
}

void StoneSurface::raise_to_mesh(const BedGeometry& bed, const CellRange& cells,
                                 std::vector<double>& samples) const {
  const double step = bed.cell_size() / samples_across;
  const double first_x = bed.x_of(cells.col_begin) + sample_offset(0) * bed.cell_size(),
               first_y = bed.y_of(cells.row_begin) + sample_offset(0) * bed.cell_size();
  const int across = cells.cols() * samples_across, along = cells.rows() * samples_across;
  // The samples from one place to another, if any; clamped before they become whole.
  const auto from = [step](double place, double first, int count) {
    return static_cast<int>(std::clamp(std::ceil((place - first) / step), 0.0, static_cast<double>(count)));
  };
  const auto until = [step](double place, double first, int count) {
    return static_cast<int>(
        std::clamp(std::floor((place - first) / step) + 1.0, 0.0, static_cast<double>(count)));
  };
  const auto raise = [&](std::int32_t triangle) {
    const auto& [first, second, third] = stone_.mesh->triangles[static_cast<std::size_t>(triangle)];
    const Eigen::Vector3d &a = corners_[static_cast<std::size_t>(first)],
                          &b = corners_[static_cast<std::size_t>(second)],
                          &c = corners_[static_cast<std::size_t>(third)];
    const auto [low_x, high_x] = std::minmax({a.x(), b.x(), c.x()});
    const auto [low_y, high_y] = std::minmax({a.y(), b.y(), c.y()});
    const int col_begin = from(low_x, first_x, across), col_end = until(high_x, first_x, across);
    const int row_begin = from(low_y, first_y, along), row_end = until(high_y, first_y, along);
    if (col_begin >= col_end || row_begin >= row_end) return;
    const double area = doubled_area(a, b, c);
    for (int row = row_begin; row < row_end; ++row)
      for (int col = col_begin; col < col_end; ++col) {
        const double x = first_x + col * step, y = first_y + row * step;
        const auto weight = [&](const Eigen::Vector3d& from_corner, const Eigen::Vector3d& to_corner) {
          return (to_corner.x() - from_corner.x()) * (y - from_corner.y()) -
                 (to_corner.y() - from_corner.y()) * (x - from_corner.x());
        };
        const double of_c = weight(a, b), of_a = weight(b, c), of_b = weight(c, a);
        if (of_a < 0.0 || of_b < 0.0 || of_c < 0.0) continue;
        double& sample = samples[static_cast<std::size_t>(row) * static_cast<std::size_t>(across) +
                                 static_cast<std::size_t>(col)];
        sample = std::max(sample, (of_a * a.z() + of_b * b.z() + of_c * c.z()) / area);
      }
  };
  // A triangle in two bands is raised to twice, which changes nothing.
  const std::size_t last = band_at(first_y + along * step);
  for (std::size_t band = band_at(first_y); band <= last; ++band)
    for (const std::int32_t triangle : bands_[band]) raise(triangle);
}

void StoneSurface::fill(const BedGeometry& bed, const CellRange& cells, double* out,
                        std::ptrdiff_t stride) const {
  const bool mesh = stone_.shape == StoneShape::mesh;
  const auto across = static_cast<std::size_t>(cells.cols() * samples_across);
  std::vector<double> samples;
  if (mesh) {
    samples.assign(across * static_cast<std::size_t>(cells.rows() * samples_across), no_stone);
    raise_to_mesh(bed, cells, samples);
  }
  for (int row = 0; row < cells.rows(); ++row)
    for (int col = 0; col < cells.cols(); ++col) {
      const double x = bed.x_of(cells.col_begin + col), y = bed.y_of(cells.row_begin + row);
      const auto sample = [&](int i, int j) {
        if (!mesh)
          return height(x + sample_offset(j) * bed.cell_size(), y + sample_offset(i) * bed.cell_size());
        return samples[static_cast<std::size_t>(row * samples_across + i) * across +
                       static_cast<std::size_t>(col * samples_across + j)];
      };
      const double centre = sample(samples_across / 2, samples_across / 2);
      double sum = 0.0;
      if (centre != no_stone)
        for (int i = 0; i < samples_of_cell; ++i)
          sum += sample(i / samples_across, i % samples_across) - centre;
      const bool whole = sum > no_stone;
      out[row * stride + col] = whole ? centre + sum / samples_of_cell : centre;
    }
}

}  // namespace sandstroke
