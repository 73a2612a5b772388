#include "tool/tool_surface.h"

#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "core/angle.h"
#include "core/elementary.h"
#include "core/error.h"

namespace sandstroke {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr int sides = 256;  // each round shape has so many: 1 - cos(pi / 256) = 7.5e-5

void add_triangle(TriangleMesh& mesh, std::int32_t a, std::int32_t b, std::int32_t c) {
  mesh.triangles.push_back({a, b, c});
}

std::int32_t add_vertex(TriangleMesh& mesh, const Vector3d& vertex) {
  mesh.vertices.push_back(vertex);
  return static_cast<std::int32_t>(mesh.vertices.size()) - 1;
}

/// A point of the unit circle. Points that are quarter turns apart have coordinates of the same bits.
Vector2d on_circle(int side) {
  const int quarter = sides / 4, within = side % quarter;
  // The second eighth mirrors the first.
  const bool mirrored = within > quarter / 2;
  const double angle = 2.0 * std::numbers::pi * (mirrored ? quarter - within : within) / sides;
  Vector2d point(elementary::cos(angle), within == 0 ? 0.0 : elementary::sin(angle));
  if (within * 2 == quarter) point.y() = point.x();
  if (mirrored) std::swap(point.x(), point.y());
  for (int turn = 0; turn < side / quarter; ++turn) point = Vector2d(-point.y(), point.x());
  return point;
}

/// Where the outside of a body's flat or pointed end looks.
enum class Facing { down, up };

/// Adds a body of revolution about z. profile: (radius, z) from the lowest to the highest point. An end on
/// the axis is one point; another end is flat.
void add_revolution(TriangleMesh& mesh, const std::vector<Vector2d>& profile, const Vector3d& at) {
  const auto ring_of = [&](const Vector2d& point) {
    const auto first = static_cast<std::int32_t>(mesh.vertices.size());
    for (int side = 0; side < sides; ++side) {
      const Vector2d xy = point.x() * on_circle(side);
      add_vertex(mesh, at + Vector3d(xy.x(), xy.y(), point.y()));
    }
    return first;
  };
  const auto fan = [&](std::int32_t tip, std::int32_t ring, Facing facing) {
    for (int side = 0; side < sides; ++side) {
      const std::int32_t one = ring + side, next = ring + (side + 1) % sides;
      if (facing == Facing::down)
        add_triangle(mesh, tip, next, one);
      else
        add_triangle(mesh, tip, one, next);
    }
  };
  const auto end_point = [&](const Vector2d& end) {
    return add_vertex(mesh, at + Vector3d(0.0, 0.0, end.y()));
  };
  std::int32_t below = -1;  // the ring under this one
  for (std::size_t i = 0; i < profile.size(); ++i) {
    const bool first = i == 0, last = i + 1 == profile.size();
    if (profile[i].x() == 0.0) {
      if (first) continue;
      fan(end_point(profile[i]), below, Facing::up);
      return;
    }
    const std::int32_t ring = ring_of(profile[i]);
    if (below < 0) {
      fan(end_point(first ? profile[i] : profile[i - 1]), ring, Facing::down);
    } else {
      for (int side = 0; side < sides; ++side) {
        const int next = (side + 1) % sides;
        add_triangle(mesh, below + side, below + next, ring + next);
        add_triangle(mesh, below + side, ring + next, ring + side);
      }
    }
    below = ring;
    if (last) fan(end_point(profile[i]), ring, Facing::up);
  }
}

enum class Arc { quarter_circle, half_circle };

/// Points (radius, z), upwards, on an arc of a sphere whose lowest point is at z = 0.
std::vector<Vector2d> sphere_profile(double radius, Arc arc) {
  std::vector<Vector2d> profile;
  const bool whole = arc == Arc::half_circle;
  const int steps = whole ? sides / 2 : sides / 4;
  for (int i = 0; i <= steps; ++i) {
    const Vector2d point = on_circle(i);  // sin(angle from the axis) is its y
    profile.emplace_back(i == 0 || (whole && i == steps) ? 0.0 : radius * point.y(),
                         radius - radius * point.x());
  }
  return profile;
}

void add_box(TriangleMesh& mesh, const Vector3d& low, const Vector3d& high) {
  const auto first = static_cast<std::int32_t>(mesh.vertices.size());
  for (int corner = 0; corner < 8; ++corner)
    add_vertex(mesh, {corner & 1 ? high.x() : low.x(), corner & 2 ? high.y() : low.y(),
                      corner & 4 ? high.z() : low.z()});
  constexpr int faces[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                               {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  for (const auto& face : faces) {
    add_triangle(mesh, first + face[0], first + face[1], first + face[2]);
    add_triangle(mesh, first + face[0], first + face[2], first + face[3]);
  }
}

void add_upright_box(TriangleMesh& mesh, double along_x, double along_y, double height) {
  add_box(mesh, {-0.5 * along_x, -0.5 * along_y, 0.0}, {0.5 * along_x, 0.5 * along_y, height});
}

/// Adds the surface of some blocks of a grid, whose planes are at xs, ys and zs: those where is_solid(i, j,
/// k).
template <class IsSolid>
void add_blocks(TriangleMesh& mesh, const std::vector<double>& xs, const std::vector<double>& ys,
                const std::vector<double>& zs, const IsSolid& is_solid) {
  const std::array<const std::vector<double>*, 3> planes = {&xs, &ys, &zs};
  using Index = std::array<int, 3>;
  const auto solid = [&](const Index& at) {
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (at[axis] < 0 || at[axis] + 1 >= static_cast<int>(planes[axis]->size())) return false;
    return is_solid(at[0], at[1], at[2]);
  };
  std::map<Index, std::int32_t> vertices;
  const auto vertex = [&](const Index& at) {
    const auto [found, is_new] = vertices.try_emplace(at, 0);
    if (is_new)
      found->second =
          add_vertex(mesh, {xs[static_cast<std::size_t>(at[0])], ys[static_cast<std::size_t>(at[1])],
                            zs[static_cast<std::size_t>(at[2])]});
    return found->second;
  };
  for (int i = -1; i < static_cast<int>(xs.size()); ++i)
    for (int j = -1; j < static_cast<int>(ys.size()); ++j)
      for (int k = -1; k < static_cast<int>(zs.size()); ++k)
        for (std::size_t axis = 0; axis < 3; ++axis) {
          const Index here = {i, j, k};
          Index next = here;
          ++next[axis];
          if (solid(here) == solid(next)) continue;
          const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
          Index corner = next;
          const std::int32_t a = vertex(corner);
          ++corner[u];
          const std::int32_t b = vertex(corner);
          ++corner[v];
          const std::int32_t c = vertex(corner);
          --corner[u];
          const std::int32_t d = vertex(corner);
          if (solid(here)) {
            add_triangle(mesh, a, b, c);
            add_triangle(mesh, a, c, d);
          } else {
            add_triangle(mesh, a, c, b);
            add_triangle(mesh, a, d, c);
          }
        }
}

/// A floor with walls at both sides and at the back.
void add_shovel(TriangleMesh& mesh, const Vector3d& size, double thickness) {
  const double x = 0.5 * size.x(), y = 0.5 * size.y();
  add_blocks(mesh, {-x, -x + thickness, x}, {-y, -y + thickness, y - thickness, y},
             {0.0, thickness, size.z()},
             [](int i, int j, int k) { return k == 0 || i == 0 || j == 0 || j == 2; });
}

void add_rake(TriangleMesh& mesh, const ToolSettings& tool) {
  std::vector<Vector2d> tooth = sphere_profile(tool.radius, Arc::quarter_circle);
  tooth.emplace_back(tool.radius, std::max(tool.height, tool.radius));
  const double middle = 0.5 * (tool.teeth - 1), top = tooth.back().y();
  for (int i = 0; i < tool.teeth; ++i) add_revolution(mesh, tooth, {0.0, (i - middle) * tool.spacing, 0.0});
  const double half = middle * tool.spacing + tool.radius;
  add_box(mesh, {-tool.radius, -half, top}, {tool.radius, half, top + 2.0 * tool.radius});
}

}  // namespace

TriangleMesh tool_surface(const ToolSettings& tool) {
  TriangleMesh mesh;
  const Vector3d origin = Vector3d::Zero();
  switch (tool.shape) {
    case ToolShape::sphere:
      add_revolution(mesh, sphere_profile(tool.radius, Arc::half_circle), origin);
      break;
    case ToolShape::cylinder:
      add_revolution(mesh, {{tool.radius, 0.0}, {tool.radius, tool.height}}, origin);
      break;
    case ToolShape::cone:
      add_revolution(mesh, {{0.0, 0.0}, {tool.radius, tool.height}}, origin);
      break;
    case ToolShape::box:
      add_upright_box(mesh, tool.size.x(), tool.size.y(), tool.size.z());
      break;
    case ToolShape::plate:
      add_upright_box(mesh, tool.thickness, tool.width, tool.height);
      break;
    case ToolShape::rake:
      add_rake(mesh, tool);
      break;
    case ToolShape::shovel:
      add_shovel(mesh, tool.size, tool.thickness);
      break;
    case ToolShape::bowl:
      add_revolution(mesh,
                     {{tool.radius, 0.0},
                      {tool.radius, tool.height},
                      {tool.radius - tool.thickness, tool.height},
                      {tool.radius - tool.thickness, tool.thickness},
                      {0.0, tool.thickness}},
                     origin);
      break;
    case ToolShape::mesh:
      if (!tool.mesh) throw_input_error("tool.shape = \"mesh\": the mesh was not read; use sandstroke run");
      return *tool.mesh;
  }
  return mesh;
}

Eigen::Matrix3d rotation_of(const Eigen::Quaterniond& orientation) {
  return orientation.toRotationMatrix().unaryExpr(
      [](double entry) { return std::round(entry * 0x1p50) * 0x1p-50; });
}

Eigen::Matrix3d own_rotation(const ToolSettings& settings) {
  const auto about = [&](int axis) {
    const double half = 0.5 * to_radians(settings.orientation[axis]);
    Eigen::Quaterniond turn(elementary::cos(half), 0.0, 0.0, 0.0);
    turn.vec()[axis] = elementary::sin(half);
    return turn;
  };
  return rotation_of((about(2) * about(1) * about(0)).normalized());
}

double tool_reach(const ToolSettings& tool) {
  if (tool.shape == ToolShape::sphere) return tool.radius;
  if (tool.shape == ToolShape::mesh && !tool.mesh) return 0.0;
  return horizontal_reach(turned(tool_surface(tool), own_rotation(tool)));
}

TriangleMesh turned(const TriangleMesh& mesh, const Eigen::Matrix3d& rotation) {
  TriangleMesh result = mesh;
  for (Vector3d& vertex : result.vertices) vertex = rotation * vertex;
  return result;
}

}  // namespace sandstroke
