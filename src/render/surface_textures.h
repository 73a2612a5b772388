#pragma once

#include <vector>

#include "render/gl_objects.h"
#include "render/horizon.h"
#include "render/render_subject.h"
#include "render/tile_detail.h"

namespace sandstroke {

/// A surface as textures for the GPU, kept from picture to picture. It holds heights in single precision, how
/// finely each tile must be drawn, slopes, how much sun and sky each cell sees, and the textures of all
/// these. Only what changed is computed and uploaded again. Tiles are compared by content, so this also works
/// for frames read from a file (whose revisions start over). The textures depend only on the surface and the
/// sun, never on what was shown before.
class SurfaceTextures {
 public:
  /// Error: input, where the bed has a side of fewer than 2 cells or more than a texture can have. A context
  /// must be current.
  static void check_size(int rows, int cols);
  /// Error: as check_size, before any memory is taken.
  explicit SurfaceTextures(const BedGeometry& bed);

  /// Takes over a surface of the same shape; returns the number of tiles that changed. Error: input, where
  /// heights are not finite.
  int update(const HeightField& surface);
  /// A tile whose patch differs from before the last update(): the cells where it differs, and its detail
  /// before.
  struct Change {
    int tile = 0;
    CellRange cells;
    TileDetail before;
  };
  const std::vector<Change>& changes() const { return changes_; }
  /// Computes the shading of tiles whose shading is out of date.
  void update_shading(const Sun& sun);
  /// A rectangle of all cells whose shading changed with the last update_shading().
  const CellRange& shaded() const { return shaded_; }

  const DrawnHeights& heights() const { return heights_; }
  /// The cells of a tile, and the first row and column of the next tiles, where there are any.
  CellRange patch(int tile) const;
  const BedGeometry& bed() const { return bed_; }
  const TileDetail& detail(int tile) const { return details_[tile]; }
  /// The box that the sand of a tile fills.
  Eigen::AlignedBox3d bounds(int tile) const { return bounds(tile, details_[tile]); }
  Eigen::AlignedBox3d bounds(int tile, const TileDetail& detail) const {
    return box_over(bed_, patch(tile), detail.lowest, detail.highest);
  }
  double lowest() const { return lowest_; }
  double highest() const { return highest_; }

  /// Heights [m] of all cells, unfiltered.
  void bind_heights(int unit) const;
  /// The same, filtered to any size.
  void bind_filtered_heights(int unit);
  /// Red, green: slope along x and y; blue: part of the sun seen; alpha: part of the sky. Filtered to any
  /// size.
  void bind_shading(int unit) const;

 private:
  /// A tile that differs from what is drawn, and the cells where it differs.
  struct ChangedTile {
    int tile = 0;
    CellRange cells;
  };
  /// Begins with a level surface, in full light: what is like it need not be computed.
  void begin_level(float height);
  /// Whether all heights of a tile's patch are this [m].
  bool is_level(int tile, double height) const;
  /// Keeps the heights of tiles that differ. Error: input, where a height is not finite.
  std::vector<ChangedTile> take_heights(const HeightField& surface);
  void mark_shading(const CellRange& changed, double relief);
  /// Marks the tiles that uneven tiles can shade, these included.
  void mark_uneven();
  void upload_shading(const std::vector<int>& tiles);

  BedGeometry bed_;
  DrawnHeights heights_, sun_, sky_;
  std::vector<TileDetail> details_;
  std::vector<Change> changes_;
  CellRange shaded_;
  std::vector<char> shading_outdated_;
  Sun sun_used_;
  double level_ = 0.0;  // m, of begin_level()
  double lowest_ = 0.0, highest_ = 0.0;
  bool filled_ = false, filtered_ = false, shading_filtered_ = false;
  GlObject height_texture_, shading_texture_;
};

}  // namespace sandstroke
