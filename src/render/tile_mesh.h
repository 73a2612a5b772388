#pragma once

#include <array>

#include "render/gl_objects.h"
#include "render/tile_detail.h"

namespace sandstroke {

/// The triangles of one tile at each level of detail, shared by all tiles: the vertex shader looks the
/// heights up. A vertex is (column, row, 0 on the surface | 1 at the bottom of the skirt), in cells from the
/// tile's first.
///
/// Around the tile hangs a skirt, from its border down to its lowest height. Two tiles share their border
/// cells and neither draws the border below the lowest of them, so that whatever gap two levels leave between
/// them has a skirt behind it.
class TileMesh {
 public:
  TileMesh();
  /// Makes a level the one to draw.
  void bind(int level) const { glBindVertexArray(levels_[level].layout); }
  /// Draws a tile of the level bound; returns the number of triangles.
  int draw(int level) const;

 private:
  struct Level {
    GlObject layout, vertices, triangles;
    int index_count = 0;
  };
  std::array<Level, coarsest_level + 1> levels_;
};

}  // namespace sandstroke
