#pragma once

#include <array>

#include "render/gl_objects.h"
#include "render/tile_detail.h"

namespace sandstroke {

/// The triangles of one tile at each level of detail. All tiles share them, and the vertex shader looks up
/// the heights. A vertex is (column, row, 0 on the surface | 1 at the bottom of the skirt), in cells from the
/// tile's first.
///
/// A skirt hangs around the tile, from its border down to below its lowest height. Two tiles share their
/// border cells, and neither draws the border below the lowest of them. So every gap between two levels has a
/// skirt behind it.
class TileMesh {
 public:
  TileMesh();
  /// Selects the level to draw.
  void bind(int level) const { glBindVertexArray(levels_[level].layout); }
  /// Draws a tile at the selected level; returns the number of triangles.
  int draw(int level) const;

 private:
  struct Level {
    GlObject layout, vertices, triangles;
    int index_count = 0;
  };
  std::array<Level, coarsest_level + 1> levels_;
};

}  // namespace sandstroke
