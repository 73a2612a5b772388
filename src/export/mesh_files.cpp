#include "export/mesh_files.h"

#include <spdlog/fmt/fmt.h>

#include <Eigen/Geometry>
#include <bit>
#include <cstring>
#include <iterator>
#include <limits>

#include "core/version.h"

namespace sandstroke {
namespace {

static_assert(std::endian::native == std::endian::little);

/// A vertex as in the files: in mm, in single precision.
Eigen::Vector3f in_file(const BedMesh& mesh, std::uint64_t vertex) {
  return (1e3 * mesh.vertex(vertex)).cast<float>();
}

std::string origin() { return fmt::format("{}; lengths in mm", build); }

template <class Value>
void put(std::ostream& file, const Value& value) {
  file.write(reinterpret_cast<const char*>(&value), sizeof value);
}
void put(std::ostream& file, const Eigen::Vector3f& vector) {
  file.write(reinterpret_cast<const char*>(vector.data()), 3 * sizeof(float));
}

/// Calls visit(number) for all vertices. False: interrupted().
template <class Visit>
bool visit_vertices(const BedMesh& mesh, const Visit& visit) {
  for (std::uint64_t i = 0; i < mesh.size().vertices; ++i) {
    if (i % 4096 == 0 && interrupted()) return false;
    visit(i);
  }
  return true;
}

bool write_stl(std::ostream& file, const BedMesh& mesh) {
  char header[80];  // a header that begins with "solid" would be taken for text
  std::memset(header, ' ', sizeof header);
  const std::string text = origin();
  text.copy(header, sizeof header);
  file.write(header, sizeof header);
  put(file, static_cast<std::uint32_t>(mesh.size().triangles));
  return mesh.visit_triangles([&](const BedMesh::Triangle& triangle) {
    Eigen::Vector3f corners[3];
    for (int i = 0; i < 3; ++i) corners[i] = in_file(mesh, triangle[i]);
    const Eigen::Vector3d a = (corners[1] - corners[0]).cast<double>(),
                          b = (corners[2] - corners[0]).cast<double>();
    put(file, Eigen::Vector3f(a.cross(b).normalized().cast<float>()));
    for (const Eigen::Vector3f& corner : corners) put(file, corner);
    put(file, std::uint16_t{0});
  });
}

bool write_ply(std::ostream& file, const BedMesh& mesh) {
  file << "ply\nformat binary_little_endian 1.0\ncomment " << origin() << "\nelement vertex "
       << mesh.size().vertices << "\nproperty float x\nproperty float y\nproperty float z\nelement face "
       << mesh.size().triangles << "\nproperty list uchar int vertex_indices\nend_header\n";
  return visit_vertices(mesh, [&](std::uint64_t i) { put(file, in_file(mesh, i)); }) &&
         mesh.visit_triangles([&](const BedMesh::Triangle& triangle) {
           put(file, std::uint8_t{3});
           for (const std::uint64_t vertex : triangle) put(file, static_cast<std::int32_t>(vertex));
         });
}

bool write_obj(std::ostream& file, const BedMesh& mesh) {
  file << "# " << origin() << '\n';
  const auto out = std::ostreambuf_iterator<char>(file);
  return visit_vertices(mesh,
                        [&](std::uint64_t i) {
                          const Eigen::Vector3f at = in_file(mesh, i);
                          fmt::format_to(out, "v {} {} {}\n", at.x(), at.y(), at.z());
                        }) &&
         mesh.visit_triangles([&](const BedMesh::Triangle& t) {
           fmt::format_to(out, "f {} {} {}\n", t[0] + 1, t[1] + 1, t[2] + 1);
         });
}

constexpr double unlimited = std::numeric_limits<double>::max(), most_uint32 = 4294967295.0,
                 most_int32 = 2147483647.0;

}  // namespace

const MeshFormat stl_format{
    {"an STL file", "sandstroke ", "lengths in mm"},
    unlimited,
    most_uint32,
    [](const MeshSize& size) { return 84.0 + 50.0 * static_cast<double>(size.triangles); },
    write_stl};
const MeshFormat ply_format{
    {"a PLY file", "ply\nformat binary_little_endian 1.0\ncomment sandstroke ", "lengths in mm"},
    most_int32,
    unlimited,
    [](const MeshSize& size) {
      return 300.0 + 12.0 * static_cast<double>(size.vertices) + 13.0 * static_cast<double>(size.triangles);
    },
    write_ply};
const MeshFormat obj_format{{"an OBJ file", "# sandstroke ", "lengths in mm"},
                            unlimited,
                            unlimited,
                            [](const MeshSize& size) {
                              return 30.0 * static_cast<double>(size.vertices) +
                                     25.0 * static_cast<double>(size.triangles);
                            },
                            write_obj};

}  // namespace sandstroke
