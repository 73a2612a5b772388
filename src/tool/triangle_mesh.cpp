#include "tool/triangle_mesh.h"

#include <Eigen/Geometry>
#include <algorithm>

#include "core/compensated_sum.h"
#include "core/elementary.h"
#include "core/hash.h"

namespace sandstroke {

std::string content_hash(const TriangleMesh& mesh) {
  ContentHash hash;
  for (const Eigen::Vector3d& vertex : mesh.vertices) hash.add(vertex.data(), sizeof vertex);
  for (const auto& corners : mesh.triangles) hash.add(corners.data(), sizeof corners);
  return hash.text();
}

double enclosed_volume(const TriangleMesh& mesh) {
  CompensatedSum volume;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const Eigen::Vector3d &a = mesh.corner(i, 0), &b = mesh.corner(i, 1), &c = mesh.corner(i, 2);
    volume.add((b - a).cross(c - a).dot(a - mesh.vertices.front()) / 6.0);
  }
  return volume.value();
}

double horizontal_reach(const TriangleMesh& mesh) {
  double reach = 0.0;
  for (const Eigen::Vector3d& vertex : mesh.vertices)
    reach = std::max(reach, elementary::hypot(vertex.x(), vertex.y()));
  return reach;
}

}  // namespace sandstroke
