#include "io/mesh_file.h"

#include <array>
#include <charconv>
#include <cstring>
#include <string>
#include <string_view>

#include "core/error.h"
#include "core/input_file.h"

namespace sandstroke {
namespace {

constexpr std::size_t most_bytes = 1'000'000'000;  // 2 million triangles as text take less

std::string whole_file(const std::filesystem::path& path) {
  InputFile file(path);
  std::string bytes;
  for (std::string_view block = file.next_block(); !block.empty(); block = file.next_block()) {
    bytes += block;
    if (bytes.size() > most_bytes)
      throw_input_error("{}: has more than {} MB; simplify the mesh", path.string(), most_bytes / 1'000'000);
  }
  return bytes;
}

/// Adds a triangle with three vertices of its own.
void add_triangle(TriangleMesh& mesh, const std::array<Eigen::Vector3d, 3>& corners) {
  const auto first = static_cast<std::int32_t>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), corners.begin(), corners.end());
  mesh.triangles.push_back({first, first + 1, first + 2});
}

// A binary file has 80 bytes of anything, a count, and for each triangle a normal, three corners (floats) and
// 2 bytes.
constexpr std::size_t header = 80, per_triangle = 50;

template <class Number>
Number number_at(const std::string& bytes, std::size_t offset) {
  Number number;
  std::memcpy(&number, bytes.data() + offset, sizeof number);
  return number;
}

bool is_binary(const std::string& bytes) {
  constexpr std::size_t begin = header + sizeof(std::uint32_t);
  if (bytes.size() < begin) return false;
  return !bytes.starts_with("solid") ||
         bytes.size() == begin + per_triangle * std::size_t{number_at<std::uint32_t>(bytes, header)};
}

TriangleMesh binary_mesh(const std::string& bytes, const std::string& name) {
  const std::size_t begin = header + sizeof(std::uint32_t), count = number_at<std::uint32_t>(bytes, header);
  if (bytes.size() < begin + per_triangle * count)
    throw_input_error("{}: is cut off: its {} triangles take {} bytes, but the file has {}; export it again",
                      name, count, begin + per_triangle * count, bytes.size());
  TriangleMesh mesh;
  for (std::size_t i = 0; i < count; ++i) {
    std::array<Eigen::Vector3d, 3> corners;
    for (std::size_t k = 0; k < 9; ++k)
      corners[k / 3][static_cast<Eigen::Index>(k % 3)] =
          static_cast<double>(number_at<float>(bytes, begin + per_triangle * i + 12 + 4 * k));
    add_triangle(mesh, corners);
  }
  return mesh;
}

/// The words of a text, one after the other, and the lines that they are on.
class Words {
 public:
  explicit Words(std::string_view text) : rest_(text) {}
  /// Empty at the end.
  std::string_view next() {
    while (!rest_.empty() && is_space(rest_.front())) {
      line_ += rest_.front() == '\n';
      rest_.remove_prefix(1);
    }
    std::size_t length = 0;
    while (length < rest_.size() && !is_space(rest_[length])) ++length;
    const std::string_view word = rest_.substr(0, length);
    rest_.remove_prefix(length);
    return word;
  }
  int line() const { return line_; }

 private:
  static bool is_space(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }
  std::string_view rest_;
  int line_ = 1;
};

TriangleMesh text_mesh(const std::string& bytes, const std::string& name) {
  TriangleMesh mesh;
  Words words(bytes);
  if (words.next() != "solid")
    throw_input_error(
        "{}: is not an STL file: it neither begins with \"solid\" nor is long enough for a binary one", name);
  std::array<Eigen::Vector3d, 3> corners;
  std::size_t corner = 0;
  for (std::string_view word = words.next(); !word.empty(); word = words.next()) {
    if (word == "facet") corner = 0;
    if (word != "vertex") continue;
    if (corner == 3)
      throw_input_error("{}:{}: a facet has more than three corners; export it again", name, words.line());
    for (double& x : corners[corner]) {
      word = words.next();
      if (!word.empty() && word.front() == '+') word.remove_prefix(1);
      const auto [end, failure] = std::from_chars(word.data(), word.data() + word.size(), x);
      if (word.empty() || failure != std::errc() || end != word.data() + word.size())
        throw_input_error("{}:{}: '{}' is not a number; a vertex has three numbers", name, words.line(),
                          word);
    }
    if (++corner == 3) add_triangle(mesh, corners);
  }
  return mesh;
}

}  // namespace

TriangleMesh parse_mesh(const std::string& bytes, double scale, const std::string& name, const MeshUse& use) {
  TriangleMesh mesh = is_binary(bytes) ? binary_mesh(bytes, name) : text_mesh(bytes, name);
  for (Eigen::Vector3d& vertex : mesh.vertices) vertex *= scale;
  return checked_mesh(mesh, name, use);
}

TriangleMesh read_mesh(const std::filesystem::path& path, double scale, const MeshUse& use) {
  return parse_mesh(whole_file(path), scale, path.string(), use);
}

ToolSettings with_mesh(ToolSettings tool, const std::filesystem::path& folder) {
  if (tool.shape == ToolShape::mesh && !tool.mesh)
    tool.mesh = std::make_shared<TriangleMesh>(read_mesh(folder / tool.file, tool.scale));
  return tool;
}

GroundSettings with_meshes(GroundSettings ground, const std::filesystem::path& folder) {
  int place = 0;
  for (StoneSettings& stone : ground.stones) {
    const std::string key = fmt::format("stone.{}", ++place);
    if (stone.shape != StoneShape::mesh || stone.mesh) continue;
    constexpr double largest_stone = 1000.0;  // m
    const MeshUse use{"stone", key + ".scale", "is put at " + key + ".centre", largest_stone};
    stone.mesh = std::make_shared<TriangleMesh>(read_mesh(folder / stone.file, stone.scale, use));
  }
  return ground;
}

}  // namespace sandstroke
