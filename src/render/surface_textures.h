#pragma once

#include <vector>

#include "render/gl_objects.h"
#include "render/horizon.h"
#include "render/render_subject.h"
#include "render/tile_detail.h"

namespace sandstroke {

/// A surface on its way to the GPU, kept from picture to picture: its heights in single precision, how finely
/// each tile must be drawn, its slopes, how much sun and sky each cell sees, and the textures of all that.
/// Only what changed is worked out and uploaded again: tiles are compared by content, so that frames read
/// from a file (whose revisions start over) take part. The textures depend on the surface and the sun only,
/// never on what was shown before.
class SurfaceTextures {
 public:
  /// Error: input, where the bed has a side of fewer than 2 cells or more than a texture can have. A context
  /// must be current.
  static void check_size(int rows, int cols);
  /// Error: as check_size, before any memory is taken.
  explicit SurfaceTextures(const BedGeometry& bed);

  /// Takes a surface of the same shape over; returns the number of tiles that changed. Error: input, where
  /// heights are not finite.
  int update(const HeightField& surface);
  /// A tile whose patch is other than before the last update(): in which cells, and what it was then.
  struct Change {
    int tile = 0;
    CellRange cells;
    TileDetail before;
  };
  const std::vector<Change>& changes() const { return changes_; }
  /// Brings what shading takes up to date with the surface.
  void update_shading(const Sun& sun);
  /// Holds all cells whose shading changed with the last update_shading().
  const CellRange& shaded() const { return shaded_; }

  const DrawnHeights& heights() const { return heights_; }
  /// The cells of a tile, and the first row and column of the tiles after it where there are any.
  CellRange patch(int tile) const;
  const BedGeometry& bed() const { return bed_; }
  const TileDetail& detail(int tile) const { return details_[tile]; }
  /// What of space the sand of a tile takes.
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
  /// A tile that differs from what is drawn, and where.
  struct ChangedTile {
    int tile = 0;
    CellRange cells;
  };
  /// Keeps the heights of those that differ. Error: input, where one is not finite.
  std::vector<ChangedTile> take_heights(const HeightField& surface);
  void mark_shading(const CellRange& changed, double relief);
  void upload_shading(const std::vector<int>& tiles);

  BedGeometry bed_;
  DrawnHeights heights_, sun_, sky_;
  std::vector<TileDetail> details_;
  std::vector<Change> changes_;
  CellRange shaded_;
  std::vector<char> shading_outdated_;
  Sun sun_used_;
  double lowest_ = 0.0, highest_ = 0.0;
  bool filled_ = false, filtered_ = false;
  GlObject height_texture_, shading_texture_;
};

}  // namespace sandstroke
