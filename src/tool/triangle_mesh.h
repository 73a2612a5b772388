#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace sandstroke {

/// The surface of a solid as triangles, counterclockwise seen from outside.
struct TriangleMesh {
  std::vector<Eigen::Vector3d> vertices;               ///< m
  std::vector<std::array<std::int32_t, 3>> triangles;  ///< indices into vertices

  const Eigen::Vector3d& corner(std::size_t triangle, int which) const {
    return vertices[static_cast<std::size_t>(triangles[triangle][static_cast<std::size_t>(which)])];
  }
  bool operator==(const TriangleMesh&) const = default;
};

/// The hash of its numbers.
std::string content_hash(const TriangleMesh& mesh);

/// The volume inside a closed surface [m^3]: the sum over triangles of a . (b x c) / 6. It is negative where
/// the surface is inside out.
double enclosed_volume(const TriangleMesh& mesh);

/// The largest distance of a corner from the vertical axis through the origin [m].
double horizontal_reach(const TriangleMesh& mesh);

}  // namespace sandstroke
