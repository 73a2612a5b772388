#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "sand/bed_geometry.h"
#include "sand/ground_settings.h"

namespace sandstroke {

/// The upper side of a stone [m], z up. What overhangs counts as filled below.
class StoneSurface {
 public:
  /// A mesh must have been read.
  explicit StoneSurface(const StoneSettings& stone);

  Eigen::AlignedBox3d bounds() const { return bounds_; }

  /// The heights of `cells` of a bed, rows `stride` apart: the mean of a cell that the stone covers wholly,
  /// the height at the centre of one that it covers in part, if its centre is, else -infinity. 7 x 7 samples
  /// of a cell tell which it is, and make the mean.
  void fill(const BedGeometry& bed, const CellRange& cells, double* out, std::ptrdiff_t stride) const;

 private:
  double height(double x, double y) const;
  void sort_into_bands();
  std::size_t band_at(double y) const;
  /// Raises the samples of `cells` to the triangles above them.
  void raise_to_mesh(const BedGeometry& bed, const CellRange& cells, std::vector<double>& samples) const;

  StoneSettings stone_;
  double cos_, sin_;                      // of the turn
  std::vector<Eigen::Vector3d> corners_;  // of a mesh, where they lie on the bed
  Eigen::AlignedBox3d bounds_;
  std::vector<std::vector<std::int32_t>> bands_;  // its triangles that face up, by bands of y that they meet
};

}  // namespace sandstroke
