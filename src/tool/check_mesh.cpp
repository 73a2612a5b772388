#include "tool/check_mesh.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "core/error.h"
#include "tool/mesh_bodies.h"

namespace sandstroke {
namespace {

constexpr std::size_t most_triangles = 2'000'000;
constexpr double least_volume = 1e-15;  // m^3

/// Merges corners that lie within a millionth of the extent. Rounding in the file's digits separates them.
TriangleMesh welded(const TriangleMesh& mesh, double extent) {
  std::map<std::array<double, 3>, std::int32_t> known;
  TriangleMesh result;
  std::vector<std::int32_t> to(mesh.vertices.size());
  const auto in_millionths = [&](double x) { return std::round(x / (1e-6 * extent)) + 0.0; };
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    const Eigen::Vector3d& vertex = mesh.vertices[i];
    const auto next = static_cast<std::int32_t>(result.vertices.size());
    const auto [entry, is_new] = known.try_emplace(
        {in_millionths(vertex.x()), in_millionths(vertex.y()), in_millionths(vertex.z())}, next);
    if (is_new) result.vertices.push_back(vertex);
    to[i] = entry->second;
  }
  for (const auto& corners : mesh.triangles) {
    const std::array<std::int32_t, 3> here = {to[static_cast<std::size_t>(corners[0])],
                                              to[static_cast<std::size_t>(corners[1])],
                                              to[static_cast<std::size_t>(corners[2])]};
    if (here[0] != here[1] && here[1] != here[2] && here[2] != here[0]) result.triangles.push_back(here);
  }
  return result;
}

/// The extent of the mesh [m].
double check_extent(const TriangleMesh& mesh, const std::string& name, const MeshUse& use) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& vertex : mesh.vertices) {
    if (!vertex.allFinite() || vertex.cwiseAbs().maxCoeff() > 1e6)
      throw_input_error(
          "{}: a corner lies at ({:g}, {:g}, {:g}), which is not a usable position; export the mesh again",
          name, vertex.x(), vertex.y(), vertex.z());
    box.extend(vertex);
  }
  const double extent = box.sizes().maxCoeff();
  if (extent > use.largest)
    throw_input_error(
        "{}: is {:.4g} m large, too large for a {}; is the mesh in millimetres? Then set {} = 0.001; "
        "otherwise set a smaller scale",
        name, extent, use.what, use.scale_key);
  const double away = box.exteriorDistance(Eigen::Vector3d(Eigen::Vector3d::Zero()));
  if (away > extent)
    throw_input_error("{}: lies {:.4g} m away from its origin, which {}; move the mesh to the origin", name,
                      away, use.origin);
  return extent;
}

/// Each edge must occur once in each direction.
void check_closed(const TriangleMesh& mesh, const std::string& name) {
  std::vector<std::pair<std::int32_t, std::int32_t>> edges;
  edges.reserve(3 * mesh.triangles.size());
  for (const auto& corners : mesh.triangles)
    for (std::size_t i = 0; i < 3; ++i) edges.emplace_back(corners[i], corners[(i + 1) % 3]);
  std::sort(edges.begin(), edges.end());
  const auto times = [&](const std::pair<std::int32_t, std::int32_t>& edge) {
    const auto [first, last] = std::equal_range(edges.begin(), edges.end(), edge);
    return last - first;
  };
  std::int64_t open = 0, turned = 0;
  for (const auto& edge : edges) {
    const auto back = times({edge.second, edge.first});
    if (times(edge) == back) continue;
    ++(back == 0 && times(edge) > 1 ? turned : open);
  }
  if (turned > 0)
    throw_input_error(
        "{}: some triangles are oriented opposite to their neighbours (at {} edges); unify the normals in "
        "the program that made the mesh",
        name, turned);
  if (open > 0)
    throw_input_error(
        "{}: is not a closed surface: {} edges have a triangle on one side only; close the holes in the "
        "program that made the mesh",
        name, open);
}

}  // namespace

TriangleMesh checked_mesh(const TriangleMesh& mesh, const std::string& name, const MeshUse& use) {
  if (mesh.triangles.size() > most_triangles)
    throw_input_error("{}: has {} triangles, but a {} may have at most {}; simplify the mesh", name,
                      mesh.triangles.size(), use.what, most_triangles);
  if (mesh.triangles.empty()) throw_input_error("{}: has no triangles; export the mesh again", name);
  TriangleMesh checked = welded(mesh, check_extent(mesh, name, use));
  if (checked.triangles.empty()) throw_input_error("{}: has no triangles; export the mesh again", name);
  checked = with_triangles_once(checked, name);
  check_closed(checked, name);
  if (!checked.triangles.empty()) checked = outermost_bodies(checked, name);
  const double volume = checked.triangles.empty() ? 0.0 : enclosed_volume(checked);
  if (!(volume > least_volume))
    throw_input_error(
        "{}: encloses {:.3g} m^3, which is too little to displace sand; use a solid, or a larger {}", name,
        volume, use.scale_key);
  return checked;
}

}  // namespace sandstroke
