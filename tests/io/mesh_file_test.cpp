#include "io/mesh_file.h"

#include <gtest/gtest.h>

#include <fstream>
#include <random>

#include "core/error.h"
#include "test_folder.h"
#include "tool/tool_surface.h"

namespace sandstroke {
namespace {

namespace fs = std::filesystem;

TriangleMesh box_mesh() {
  ToolSettings box;
  box.shape = ToolShape::box;
  return tool_surface(box);
}

std::string binary_stl(const TriangleMesh& mesh) {
  std::string bytes(80, ' ');
  const auto put = [&](const auto& value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
  };
  put(static_cast<std::uint32_t>(mesh.triangles.size()));
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    for (int k = 0; k < 3; ++k) put(0.0f);
    for (int corner = 0; corner < 3; ++corner)
      for (const double x : mesh.corner(i, corner)) put(static_cast<float>(x));
    put(std::uint16_t{0});
  }
  return bytes;
}
std::string text_stl(const TriangleMesh& mesh) {
  std::string text = "solid tool\n";
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    text += "facet normal 0 0 0\nouter loop\n";
    for (int corner = 0; corner < 3; ++corner) {
      const Eigen::Vector3d& v = mesh.corner(i, corner);
      text += fmt::format("vertex {} {} {}\n", v.x(), v.y(), v.z());
    }
    text += "endloop\nendfacet\n";
  }
  return text + "endsolid tool\n";
}
class MeshFile : public testing::Test {
 protected:
  TestFolder folder;
  TriangleMesh read(const std::string& bytes, const std::string& file = "tool.stl", double scale = 1.0) {
    std::ofstream(folder.path() / file, std::ios::binary) << bytes;
    return read_mesh(folder.path() / file, scale);
  }
  std::string complaint(const std::string& bytes, const std::string& file = "tool.stl", double scale = 1.0) {
    try {
      read(bytes, file, scale);
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  }
};

TEST_F(MeshFile, IsReadFromEachFormat) {
  const TriangleMesh box = box_mesh();
  const double volume = enclosed_volume(box);
  for (const auto& [file, bytes] : {std::pair{"a.stl", binary_stl(box)}, {"b.STL", text_stl(box)}}) {
    const TriangleMesh mesh = read(bytes, file);
    EXPECT_EQ(mesh.vertices.size(), 8u) << file;
    EXPECT_EQ(mesh.triangles.size(), 12u) << file;
    EXPECT_NEAR(enclosed_volume(mesh), volume, 1e-6 * volume) << file;
  }
  EXPECT_NEAR(enclosed_volume(read(binary_stl(box), "half.stl", 0.5)), volume / 8.0, 1e-6 * volume);
}

TEST_F(MeshFile, WhatIsNoToolIsSaidInASentence) {
  const TriangleMesh box = box_mesh();
  EXPECT_NE(
      complaint(binary_stl(box), "mm.stl", 1000.0)
          .find("40 m large, too large for a tool; is the mesh in millimetres? Then set tool.scale = 0.001"),
      std::string::npos);
  TriangleMesh open = box;
  open.triangles.pop_back();
  EXPECT_NE(complaint(binary_stl(open)).find("3 edges have a triangle on one side only"), std::string::npos);
  TriangleMesh twisted = box;
  std::swap(twisted.triangles[0][0], twisted.triangles[0][1]);
  EXPECT_NE(complaint(binary_stl(twisted)).find("oriented opposite to their neighbours"), std::string::npos);
  TriangleMesh flat = box, thin = box;
  for (Eigen::Vector3d& vertex : flat.vertices) vertex.z() = 0.0;
  EXPECT_NE(complaint(text_stl(flat)).find("4 edges have a triangle on one side only"), std::string::npos);
  for (Eigen::Vector3d& vertex : thin.vertices) vertex *= 1e-4;
  EXPECT_NE(complaint(text_stl(thin)).find("too little to displace sand"), std::string::npos);
  TriangleMesh away = box;
  for (Eigen::Vector3d& vertex : away.vertices) vertex.x() += 0.5;
  EXPECT_NE(complaint(binary_stl(away)).find("away from its origin"), std::string::npos);
  EXPECT_NE(complaint(binary_stl(box).substr(0, 300)).find("is cut off"), std::string::npos);
  EXPECT_NE(complaint("").find("is not an STL file"), std::string::npos);
  EXPECT_NE(complaint("solid a\nfacet\nvertex 0 0 1,5").find("tool.stl:3: '1,5' is not a number"),
            std::string::npos);
}

TEST_F(MeshFile, CornersThatDifferByDigitsAreOne) {
  std::string text = text_stl(box_mesh());
  for (std::size_t at = text.find("vertex -0.01 "); at != std::string::npos;
       at = text.find("vertex -0.01 ", at + 30))
    if (at % 2 == 0) text.replace(at, 12, "vertex -0.010000001");
  EXPECT_EQ(read(text).vertices.size(), 8u);
}

TEST_F(MeshFile, InsideOutIsMended) {
  TriangleMesh box = box_mesh();
  for (auto& corners : box.triangles) std::swap(corners[0], corners[1]);
  EXPECT_GT(enclosed_volume(read(binary_stl(box))), 0.0);
}

TEST_F(MeshFile, ASurfaceThatIsThereTwiceIsReadOnce) {
  TriangleMesh twice = box_mesh();
  const std::size_t once = twice.triangles.size();
  for (std::size_t i = 0; i < once; ++i) twice.triangles.push_back(twice.triangles[i]);
  for (const auto& [file, bytes] : {std::pair{"a.stl", binary_stl(twice)}, {"b.stl", text_stl(twice)}})
    EXPECT_EQ(read(bytes, file),
              read(file[0] == 'a' ? binary_stl(box_mesh()) : text_stl(box_mesh()), "once.stl"));
}

TEST_F(MeshFile, SolidsThatOverlapAreRefused) {
  TriangleMesh two = box_mesh();
  for (const Eigen::Vector3d& vertex : box_mesh().vertices)
    two.vertices.emplace_back(vertex + Eigen::Vector3d(0.01, 0.002, 0.001));
  for (const auto& t : box_mesh().triangles) two.triangles.push_back({t[0] + 8, t[1] + 8, t[2] + 8});
  EXPECT_NE(complaint(binary_stl(two)).find("tool.stl: two of its 2 bodies overlap or touch"),
            std::string::npos);
  for (std::size_t i = 8; i < 16; ++i) two.vertices[i].x() += 0.05;
  EXPECT_EQ(complaint(binary_stl(two)), "");
}

TEST_F(MeshFile, TwoHundredHostileFilesAreReadOrRefused) {
  const TriangleMesh box = box_mesh();
  const std::pair<std::string, std::string> whole[] = {{"h.stl", binary_stl(box)}, {"t.stl", text_stl(box)}};
  std::mt19937 random(7);
  int refused = 0;
  for (int i = 0; i < 200; ++i) {
    const std::string file = whole[i % 2].first;
    std::string bytes = whole[i % 2].second;
    const auto position = [&] { return random() % bytes.size(); };
    if (i % 3 == 0) bytes.resize(position());
    for (unsigned k = 0; !bytes.empty() && k < 1 + random() % 6; ++k) {
      if (i % 5 == 4)
        bytes.insert(position(), "nan -1e999 ");
      else
        bytes[position()] = static_cast<char>(random());
    }
    const std::string said = complaint(bytes, file);
    refused += !said.empty();
    EXPECT_TRUE(!said.empty() || enclosed_volume(read(bytes, file)) > 0.0);
  }
  EXPECT_GT(refused, 100);
}

TEST_F(MeshFile, StonesAreReadAndNamedInErrors) {
  GroundSettings ground;
  ground.stones.resize(3);
  ground.stones[1].shape = StoneShape::mesh;
  ground.stones[1].file = "rock.stl";
  ground.stones[1].scale = 50.0;  // larger than any tool
  std::ofstream(folder.path() / "rock.stl", std::ios::binary) << binary_stl(box_mesh());
  const GroundSettings read = with_meshes(ground, folder.path());
  EXPECT_EQ(read.stones[0].mesh, nullptr);
  ASSERT_NE(read.stones[1].mesh, nullptr);
  EXPECT_NEAR(enclosed_volume(*read.stones[1].mesh), 125000.0 * enclosed_volume(box_mesh()), 1e-3);

  ground.stones[1].scale = 1e6;
  try {
    with_meshes(ground, folder.path());
    ADD_FAILURE();
  } catch (const Error& error) {
    const std::string said = error.what();
    EXPECT_NE(said.find("too large for a stone"), std::string::npos) << said;
    EXPECT_NE(said.find("set stone.2.scale = 0.001"), std::string::npos) << said;
    EXPECT_EQ(said.find("tool"), std::string::npos) << said;
  }
}

}  // namespace
}  // namespace sandstroke
