#include "tool/mesh_bodies.h"

#include <spdlog/fmt/fmt.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/disjoint_sets.h"
#include "core/elementary.h"
#include "core/error.h"
#include "core/warning.h"
#include "tool/mesh_overlap.h"

namespace sandstroke {
namespace {

using Eigen::AlignedBox3d;
using Eigen::Vector3d;

constexpr std::size_t most_bodies = 1000;
constexpr double touching = 2e-6;  // of the extent: corners that lie within a millionth are one

/// A triangle by its corners in ascending order, and whether it faces as that order says.
struct Facet {
  std::array<std::int32_t, 3> corners;
  int facing;  // 1 or -1
  std::size_t triangle;
};

Facet facet_of(std::array<std::int32_t, 3> corners, std::size_t triangle) {
  std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
  const int facing = corners[1] < corners[2] ? 1 : -1;
  if (facing < 0) std::swap(corners[1], corners[2]);
  return {corners, facing, triangle};
}

/// The mesh with these triangles only, and the vertices that they need.
TriangleMesh part_of(const TriangleMesh& mesh, const std::vector<std::size_t>& triangles) {
  TriangleMesh part;
  std::vector<std::int32_t> to(mesh.vertices.size(), -1);
  for (const std::size_t i : triangles) {
    std::array<std::int32_t, 3> corners = mesh.triangles[i];
    for (std::int32_t& corner : corners) {
      const auto from = static_cast<std::size_t>(corner);
      if (to[from] < 0) {
        to[from] = static_cast<std::int32_t>(part.vertices.size());
        part.vertices.push_back(mesh.vertices[from]);
      }
      corner = to[from];
    }
    part.triangles.push_back(corners);
  }
  return part;
}

void append(TriangleMesh& mesh, const TriangleMesh& part) {
  const auto first = static_cast<std::int32_t>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), part.vertices.begin(), part.vertices.end());
  for (const auto& corners : part.triangles)
    mesh.triangles.push_back({first + corners[0], first + corners[1], first + corners[2]});
}

/// The triangles of each body, in the order of their first ones.
std::vector<std::vector<std::size_t>> parts_of(const TriangleMesh& mesh) {
  DisjointSets linked(mesh.vertices.size());
  for (const auto& corners : mesh.triangles)
    for (const std::int32_t other : {corners[1], corners[2]})
      linked.join(static_cast<std::size_t>(corners[0]), static_cast<std::size_t>(other));
  std::vector<std::vector<std::size_t>> parts;
  std::vector<std::size_t> part_at(mesh.vertices.size(), mesh.triangles.size());
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    std::size_t& part = part_at[linked.root(static_cast<std::size_t>(mesh.triangles[i][0]))];
    if (part == mesh.triangles.size()) {
      part = parts.size();
      parts.emplace_back();
    }
    parts[part].push_back(i);
  }
  return parts;
}

std::vector<TriangleMesh> bodies_of(const TriangleMesh& mesh, const std::string& name) {
  const std::vector<std::vector<std::size_t>> parts = parts_of(mesh);
  if (parts.size() > most_bodies)
    throw_input_error(
        "{}: has {} bodies that do not hang together, but a tool may have at most {}; unite them in the "
        "program that made the mesh",
        name, parts.size(), most_bodies);
  std::vector<TriangleMesh> bodies;
  for (const std::vector<std::size_t>& triangles : parts) bodies.push_back(part_of(mesh, triangles));
  return bodies;
}

AlignedBox3d box_of(const TriangleMesh& mesh) {
  AlignedBox3d box;
  for (const Vector3d& vertex : mesh.vertices) box.extend(vertex);
  return box;
}

/// How often a closed surface goes around a point: the solid angles in which its triangles are seen (Van
/// Oosterom & Strackee 1983), by 4 pi.
double winding_number(const TriangleMesh& surface, const Vector3d& point) {
  double sum = 0.0;
  for (std::size_t i = 0; i < surface.triangles.size(); ++i) {
    const Vector3d a = surface.corner(i, 0) - point, b = surface.corner(i, 1) - point,
                   c = surface.corner(i, 2) - point;
    const double la = a.norm(), lb = b.norm(), lc = c.norm();
    sum += 2.0 *
           elementary::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
  }
  return sum / (4.0 * std::numbers::pi);
}

/// A place in mm, as text.
std::string place_text(const Vector3d& place) {
  const auto mm = [](double x) { return std::round(1e6 * x) / 1e3 + 0.0; };  // no -0
  return fmt::format("({:g}, {:g}, {:g}) mm", mm(place.x()), mm(place.y()), mm(place.z()));
}

void check_apart(const TriangleMesh& mesh, const std::vector<TriangleMesh>& bodies, const std::string& name) {
  TriangleMesh all;  // body after body
  std::vector<std::size_t> body_at;
  for (std::size_t body = 0; body < bodies.size(); ++body) {
    append(all, bodies[body]);
    body_at.resize(all.triangles.size(), body);
  }
  const auto pair = overlapping_triangles(all, touching * box_of(mesh).sizes().maxCoeff());
  if (!pair) return;
  const std::size_t one = body_at[pair->first], other = body_at[pair->second];
  const Vector3d near =
      (all.corner(pair->first, 0) + all.corner(pair->first, 1) + all.corner(pair->first, 2)) / 3.0;
  if (one == other)
    throw_input_error(
        "{}: the surface passes through itself near {}; unite its parts, or repair it, in the program that "
        "made the mesh",
        name, place_text(near));
  const AlignedBox3d box = box_of(bodies[one]), there = box_of(bodies[other]);
  const Vector3d shared = 1e3 * box.intersection(there).sizes();
  throw_input_error(
      "{}: two of its {} bodies overlap or touch, those around {} and {} (their boxes share {:.4g} x {:.4g} "
      "x {:.4g} mm), and what they share would count twice; unite them in the program that made the mesh",
      name, bodies.size(), place_text(box.center()), place_text(there.center()), shared.x(), shared.y(),
      shared.z());
}

/// Flags the bodies that lie in another one; no two surfaces meet.
std::vector<bool> inner_ones(const std::vector<TriangleMesh>& bodies) {
  std::vector<AlignedBox3d> boxes;
  for (const TriangleMesh& body : bodies) boxes.push_back(box_of(body));
  std::vector<bool> inner(bodies.size(), false);
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const Vector3d point = (bodies[i].corner(0, 0) + bodies[i].corner(0, 1) + bodies[i].corner(0, 2)) / 3.0;
    for (std::size_t other = 0; other < bodies.size() && !inner[i]; ++other)
      inner[i] = other != i && boxes[other].contains(boxes[i]) &&
                 std::abs(winding_number(bodies[other], point)) > 0.5;
  }
  return inner;
}

}  // namespace

TriangleMesh with_triangles_once(const TriangleMesh& mesh, const std::string& name) {
  std::vector<std::size_t> kept;
  for (const std::vector<std::size_t>& part : parts_of(mesh)) {
    std::vector<Facet> facets;
    for (const std::size_t i : part) facets.push_back(facet_of(mesh.triangles[i], i));
    std::sort(facets.begin(), facets.end(), [](const Facet& a, const Facet& b) {
      return std::pair(a.corners, a.triangle) < std::pair(b.corners, b.triangle);
    });
    const std::size_t kept_before = kept.size();
    std::vector<std::size_t> first_of_each;
    for (std::size_t begin = 0, end; begin < facets.size(); begin = end) {
      first_of_each.push_back(facets[begin].triangle);
      int facing = 0;
      for (end = begin; end < facets.size() && facets[end].corners == facets[begin].corners; ++end)
        facing += facets[end].facing;
      if (facing == 0) continue;
      while (facets[begin].facing != (facing > 0 ? 1 : -1)) ++begin;
      kept.push_back(facets[begin].triangle);
    }
    // A body all of whose triangles face both ways is a surface that was made two-sided for a renderer.
    if (kept.size() == kept_before) kept.insert(kept.end(), first_of_each.begin(), first_of_each.end());
  }
  if (kept.size() == mesh.triangles.size()) return mesh;
  warn(
      {WarningCode::tool_mesh,
       fmt::format(
           "{}: {} of its {} triangles lie on others, as in a surface that is there twice or where two parts "
           "touch; each counts once, or not at all inside the tool",
           name, mesh.triangles.size() - kept.size(), mesh.triangles.size())});
  std::sort(kept.begin(), kept.end());
  return part_of(mesh, kept);
}

TriangleMesh outermost_bodies(const TriangleMesh& mesh, const std::string& name) {
  std::vector<TriangleMesh> bodies = bodies_of(mesh, name);
  check_apart(mesh, bodies, name);
  const std::vector<bool> is_inner = inner_ones(bodies);
  const auto inner = std::count(is_inner.begin(), is_inner.end(), true);
  TriangleMesh outer;
  std::size_t turned_over = 0;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (is_inner[i]) continue;
    const bool inside_out = enclosed_volume(bodies[i]) < 0.0;
    turned_over += inside_out;
    if (inside_out)
      for (std::array<std::int32_t, 3>& corners : bodies[i].triangles) std::swap(corners[1], corners[2]);
    append(outer, bodies[i]);
  }
  if (inner > 0)
    warn({WarningCode::tool_mesh,
          fmt::format("{}: {} of its {} bodies lie in others, where no sand meets them; they are left out",
                      name, inner, bodies.size())});
  if (turned_over > 0 && bodies.size() == 1)
    warn({WarningCode::tool_mesh, fmt::format("{}: is inside out; its triangles are turned over", name)});
  if (turned_over > 0 && bodies.size() > 1)
    warn({WarningCode::tool_mesh,
          fmt::format("{}: {} of its {} bodies are inside out; their triangles are turned over", name,
                      turned_over, bodies.size())});
  return inner == 0 && turned_over == 0 && bodies.size() == 1 ? mesh : outer;
}

}  // namespace sandstroke
