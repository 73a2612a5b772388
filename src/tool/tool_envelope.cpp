#include "tool/tool_envelope.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/cells_per_group.h"
#include "core/elementary.h"
#include "core/error.h"
#include "tool/distance_transform.h"
#include "tool/triangle_samples.h"

namespace sandstroke {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double most_samples = 1.6e7;  // 130 MB per field
constexpr double most_distance = 1.4;   // the largest displacement.distance

}  // namespace

ToolEnvelope::ToolEnvelope(const TriangleMesh& surface, double cell_size) : cell_size_(cell_size) {
  Eigen::AlignedBox3d box;
  for (const Vector3d& vertex : surface.vertices) box.extend(vertex);
  const Vector2d size = box.sizes().head<2>();
  const double margin = (most_distance - 1.0) * 0.5 * size.minCoeff() + 3.0 * cell_size;
  const auto first = [&](double low) { return std::floor((low - margin) / cell_size); };
  const auto count = [&](double low, double high) {
    return std::ceil((high + margin) / cell_size) - first(low) + 1.0;
  };
  const double cols = count(box.min().x(), box.max().x()), rows = count(box.min().y(), box.max().y());
  while (phases_ > 1 && cols * rows * phases_ * phases_ > most_samples) phases_ /= 2;
  if (!(cols * rows <= most_samples))
    throw_input_error(
        "the tool is {:.4g} m by {:.4g} m, which is {:.3g} cells; take a smaller tool or fewer bed.cells",
        size.x(), size.y(), size.x() * size.y() / (cell_size * cell_size));
  first_col_ = static_cast<int>(first(box.min().x()));
  first_row_ = static_cast<int>(first(box.min().y()));
  cols_ = static_cast<int>(cols);
  rows_ = static_cast<int>(rows);
  stride_ = cols_ + 2 * cells_per_group;
  for (int row = 0; row < sample_rows(); ++row) rows_at_.push_back(at(row / phases_, 0, row % phases_, 0));
  for (int col = 0; col < sample_cols(); ++col) cols_at_.push_back(at(0, col / phases_, 0, col % phases_));
  rasterise(surface);
}

void ToolEnvelope::rasterise(const TriangleMesh& surface) {
  const std::size_t samples = at(0, 0, phases_, 0);
  underside_.assign(samples, infinite);
  cover_.assign(samples, 0.0);
  for (std::size_t i = 0; i < surface.triangles.size(); ++i)
    draw_triangle(surface.corner(i, 0), surface.corner(i, 1), surface.corner(i, 2));
  lowest_ = infinite;
  highest_ = -infinite;
  for (int row = 0; row < sample_rows(); ++row)
    for (int col = 0; col < sample_cols(); ++col) {
      const double height = underside_[at_sample(row, col)];
      if (height == infinite) continue;
      cover_[at_sample(row, col)] = 1.0;
      lowest_ = std::min(lowest_, height);
      highest_ = std::max(highest_, height);
      const Vector2d position(first_col_ + static_cast<double>(col) / phases_,
                              first_row_ + static_cast<double>(row) / phases_);
      reach_ = std::max(reach_, cell_size_ * elementary::hypot(position.x(), position.y()));
    }
  if (lowest_ == infinite)
    throw_input_error(
        "the tool is so thin that it covers no cell of the bed; take more bed.cells or a thicker tool");
  continue_beyond_edge();
  const std::vector<double> inside = distance_inside(covered_up_to(highest_), sample_rows(), sample_cols());
  inradius_ = *std::max_element(inside.begin(), inside.end()) * cell_size_ / phases_;
}

/// Lowers the samples over a triangle, its edges included, to its height if that is lower.
void ToolEnvelope::draw_triangle(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  const int origin_x = first_col_ * phases_, origin_y = first_row_ * phases_;
  visit_triangle_samples(a, b, c, phases_ / cell_size_, [&](int x, int y, double z) {
    double& height = underside_[at_sample(y - origin_y, x - origin_x)];
    height = std::min(height, z);
  });
}

/// Gives the samples just beyond the edge a height, since heights are interpolated between a covered sample
/// and its neighbour.
void ToolEnvelope::continue_beyond_edge() {
  std::vector<double> continued = underside_;
  for (int row = 1; row < sample_rows() - 1; ++row)
    for (int col = 1; col < sample_cols() - 1; ++col) {
      const double here = underside_[at_sample(row, col)];
      if (here == infinite) continue;
      for (int r = row - 1; r <= row + 1; ++r)
        for (int c = col - 1; c <= col + 1; ++c)
          if (cover_[at_sample(r, c)] == 0.0)
            continued[at_sample(r, c)] = std::min(continued[at_sample(r, c)], here);
    }
  for (double& height : continued)
    if (height == infinite) height = 0.0;
  underside_ = std::move(continued);
}

double ToolEnvelope::covered_height(double height) const {
  // Levels: one cell above the lowest point, then 1.5 and 2 cells, 3 and 4, ...
  double steps = cell_size_;
  for (int k = 0; lowest_ + steps < height && lowest_ + steps < highest_; ++k)
    steps *= k % 2 == 0 ? 1.5 : 4.0 / 3.0;
  return std::min(lowest_ + steps, highest_);
}

const WayOut& ToolEnvelope::way_out(double height, double distance, int phase_y, int phase_x) {
  const std::tuple key(height, phase_y, phase_x);
  if (const auto found = ways_out_.find(key); found != ways_out_.end()) return found->second;
  auto part = parts_.find(height);
  if (part == parts_.end()) {
    std::vector<double> inside = signed_distance(covered_up_to(height), sample_rows(), sample_cols());
    const double deepest = *std::max_element(inside.begin(), inside.end());
    part = parts_.emplace(height, Part{std::move(inside), deepest}).first;
  }
  return ways_out_.emplace(key, make_way_out(part->second, distance, phase_y, phase_x)).first->second;
}

void ToolEnvelope::make_ways_out(double distance) {
  for (double height = covered_height(lowest_);; height = covered_height(std::nextafter(height, infinite))) {
    for (int phase_y = 0; phase_y < phases_; ++phase_y)
      for (int phase_x = 0; phase_x < phases_; ++phase_x) way_out(height, distance, phase_y, phase_x);
    if (height == highest_) break;
  }
  parts_.clear();
}

std::vector<unsigned char> ToolEnvelope::covered_up_to(double height) const {
  std::vector<unsigned char> covered;
  covered.reserve(underside_.size());
  for (int row = 0; row < sample_rows(); ++row)
    for (int col = 0; col < sample_cols(); ++col)
      covered.push_back(cover_[at_sample(row, col)] > 0.0 && underside_[at_sample(row, col)] <= height);
  return covered;
}

WayOut ToolEnvelope::make_way_out(const Part& part, double distance, int phase_y, int phase_x) const {
  const int rows = sample_rows(), cols = sample_cols();
  const std::vector<double>& inside = part.inside;
  const auto index = [&](int row, int col) {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(cols) + static_cast<std::size_t>(col);
  };
  const double beyond = std::max((distance - 1.0) * part.deepest, 0.5 * phases_);  // samples
  WayOut way;
  const auto size = static_cast<std::size_t>(rows_) * static_cast<std::size_t>(stride_);
  way.x.assign(size, 0.0);
  way.y.assign(size, 0.0);
  constexpr int around = 3;
  for (int row = phase_y; row < rows - around; row += phases_)
    for (int col = phase_x; col < cols - around; col += phases_) {
      if (row < around || col < around || !(inside[index(row, col)] > 0.0)) continue;
      // Outward is down the gradient of the distance, by least squares. The terms are multiples of a quantum,
      // so the sums are exact, and exactly 0 if two edges are equally near.
      Vector2d outward = Vector2d::Zero();
      for (int r = -around; r <= around; ++r)
        for (int c = -around; c <= around; ++c) outward -= inside[index(row + r, col + c)] * Vector2d(c, r);
      const double length = elementary::hypot(outward.x(), outward.y());
      if (length == 0.0) continue;
      const double far = (inside[index(row, col)] + beyond) / (length * phases_);
      const std::size_t cell = at(row / phases_, col / phases_, 0, 0);
      way.x[cell] = far * outward.x();
      way.y[cell] = far * outward.y();
    }
  return way;
}

}  // namespace sandstroke
