#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>

#include "core/interrupt.h"
#include "sand/height_field.h"

namespace sandstroke {

struct MeshSize {
  std::uint64_t vertices = 0, triangles = 0;
};

/// The size of the mesh of so many cells: of a body, or of its surface alone.
MeshSize mesh_size(int rows, int cols, bool body);

/// A bed as triangles. The surface has a vertex at the centre of every cell, and reaches the walls at the
/// height of the cells beside them. A body also has the walls and a floor: then every edge has two triangles,
/// one in each direction. All face outwards, counterclockwise. Only the heights are stored.
class BedMesh {
 public:
  /// base [m] > 0: the floor of a body lies this far below the lowest height; none: the surface alone.
  /// `heights` [m] must outlive this.
  BedMesh(const HeightGrid& heights, double cell_size, std::optional<double> base);

  using Triangle = std::array<std::uint64_t, 3>;  ///< numbers of vertices, from 0
  MeshSize size() const { return size_; }
  /// [m]; the bed's centre is x = y = 0.
  Eigen::Vector3d vertex(std::uint64_t number) const;

  /// Calls visit(Triangle) for each triangle. False: interrupted().
  template <class Visit>
  bool visit_triangles(const Visit& visit) const {
    for (std::uint64_t row = 0; row + 1 < rows_; ++row) {
      if (interrupted()) return false;
      for (std::uint64_t col = 0; col + 1 < cols_; ++col) {
        const std::uint64_t here = row * cols_ + col, above = here + cols_;
        visit(Triangle{here, here + 1, above + 1});
        visit(Triangle{here, above + 1, above});
      }
    }
    if (!floor_) return true;
    const std::uint64_t first = rows_ * cols_, ring = ring_size(), centre = first + ring;
    for (std::uint64_t k = 0; k < ring; ++k) {
      const std::uint64_t next = (k + 1) % ring;
      visit(Triangle{first + k, first + next, on_ring(next)});
      visit(Triangle{first + k, on_ring(next), on_ring(k)});
      visit(Triangle{centre, first + next, first + k});
    }
    return true;
  }

 private:
  // The surface's vertices are rows_ x cols_, two more each way than the cells. Those of a body's floor come
  // after them: a border below the surface's border, counterclockwise from the first corner, and the centre.
  std::uint64_t ring_size() const { return 2 * (rows_ - 1) + 2 * (cols_ - 1); }
  std::uint64_t on_ring(std::uint64_t k) const;  // the surface's vertex above vertex k of the floor's border
  Eigen::Vector3d on_surface(std::uint64_t number) const;

  const HeightGrid& heights_;
  BedGeometry bed_;
  std::uint64_t rows_, cols_;
  std::optional<double> floor_;  // m
  MeshSize size_;
};

}  // namespace sandstroke
