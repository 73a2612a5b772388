#pragma once

#include <vector>

#include "core/aligned_vector.h"
#include "tool/triangle_mesh.h"

namespace sandstroke {

/// A tool's surface as elements of about one size. Forces are summed over them. They are sorted by their
/// height on the unturned tool, the lowest first, in layers of that size; within a layer, elements that face
/// alike lie together. Columns have size() entries, a multiple of 8; entries beyond count() have no area.
class ToolElements {
 public:
  /// Divides triangles larger than `size` [m]. Those that lie in one cube of that size and face about the
  /// same way become one element, so the number of elements follows the surface, not the mesh. surface: in
  /// its own frame, tip at the origin [m].
  ToolElements(const TriangleMesh& surface, double size);

  /// Sets positions and normals to those of the surface turned about the tip.
  void turn(const Eigen::Matrix3d& rotation);
  const Eigen::Matrix3d& rotation() const { return rotation_; }

  std::size_t size() const { return size_; }
  int count() const { return count_; }
  const double* x() const { return column(0); }  ///< m, from the tip
  const double* y() const { return column(1); }
  const double* z() const { return column(2); }
  const double* normal_x() const { return column(3); }  ///< outward, a unit vector
  const double* normal_y() const { return column(4); }
  const double* normal_z() const { return column(5); }
  const double* area() const { return column(6); }  ///< m^2
  double lowest() const { return lowest_; }         ///< m above the tip, of the centres

 private:
  const double* column(std::size_t i) const { return columns_.data() + i * size_; }

  std::size_t size_ = 0;
  int count_ = 0;
  double lowest_ = 0.0;
  Eigen::Matrix3d rotation_ = Eigen::Matrix3d::Zero();  // none yet
  std::vector<Eigen::Vector3d> centres_, normals_;      // in its own frame
  AlignedVector<double> columns_;
};

}  // namespace sandstroke
