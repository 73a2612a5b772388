#include "render/tile_mesh.h"

#include <cstdint>
#include <vector>

namespace sandstroke {
namespace {

using TileVertex = std::array<std::int16_t, 3>;

}  // namespace

TileMesh::TileMesh() {
  for (int level = 0; level <= coarsest_level; ++level) {
    const int side = HeightField::tile_side >> level;  // squares
    std::vector<TileVertex> vertices;
    std::vector<std::uint16_t> triangles;
    const auto vertex = [&](int col, int row, int skirt) {
      vertices.push_back({static_cast<std::int16_t>(col << level), static_cast<std::int16_t>(row << level),
                          static_cast<std::int16_t>(skirt)});
    };
    const auto square = [&](int a, int b, int c, int d) {  // a - b lies below c - d
      for (const int corner : {a, b, d, a, d, c}) triangles.push_back(static_cast<std::uint16_t>(corner));
    };
    for (int row = 0; row <= side; ++row)
      for (int col = 0; col <= side; ++col) vertex(col, row, 0);
    const auto surface = [&](int col, int row) { return row * (side + 1) + col; };
    for (int row = 0; row < side; ++row)
      for (int col = 0; col < side; ++col)
        square(surface(col, row), surface(col + 1, row), surface(col, row + 1), surface(col + 1, row + 1));

    // The skirt, one side after the other. Its bottom follows the border.
    const auto hang = [&](int col, int row, int step_col, int step_row) {
      for (int i = 0; i <= side; ++i) {
        vertex(col + i * step_col, row + i * step_row, 1);
        if (i == 0) continue;
        const int bottom = static_cast<int>(vertices.size()) - 1;
        const int before = surface(col + (i - 1) * step_col, row + (i - 1) * step_row);
        square(bottom - 1, bottom, before, surface(col + i * step_col, row + i * step_row));
      }
    };
    hang(0, 0, 1, 0);
    hang(0, side, 1, 0);
    hang(0, 0, 0, 1);
    hang(side, 0, 0, 1);

    Level& made = levels_[level];
    made.index_count = static_cast<int>(triangles.size());
    made.layout = make_vertex_array();
    glBindVertexArray(made.layout);
    made.vertices = make_buffer();
    glBindBuffer(GL_ARRAY_BUFFER, made.vertices);
    glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(vertices.size() * sizeof(TileVertex)),
                 vertices.data(), GL_STATIC_DRAW);
    glEnableVertexAttribArray(0);
    glVertexAttribIPointer(0, 3, GL_SHORT, sizeof(TileVertex), nullptr);
    made.triangles = make_buffer();
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, made.triangles);
    glBufferData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLsizeiptr>(triangles.size() * sizeof(std::uint16_t)),
                 triangles.data(), GL_STATIC_DRAW);
  }
  check_gl("making the meshes");
}

int TileMesh::draw(int level) const {
  glDrawElements(GL_TRIANGLES, levels_[level].index_count, GL_UNSIGNED_SHORT, nullptr);
  return levels_[level].index_count / 3;
}

}  // namespace sandstroke
