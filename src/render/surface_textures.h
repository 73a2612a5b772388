#pragma once

#include <vector>

#include "render/gl_objects.h"
#include "render/horizon.h"
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
  /// Brings what shading takes up to date with the surface.
  void update_shading(const Sun& sun);

  const DrawnHeights& heights() const { return heights_; }
  /// The cells of a tile, and the first row and column of the tiles after it where there are any.
  CellRange patch(int tile) const;
  const TileDetail& detail(int tile) const { return details_[tile]; }
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
  /// Which tiles differ from what is drawn; their heights are kept. Error: input, where one is not finite.
  std::vector<int> take_heights(const HeightField& surface);
  void mark_shading(int tile, double relief);

  BedGeometry bed_;
  DrawnHeights heights_, sun_, sky_;
  std::vector<TileDetail> details_;
  std::vector<char> shading_outdated_;
  Sun sun_used_;
  double lowest_ = 0.0, highest_ = 0.0;
  bool filled_ = false, filtered_ = false;
  GlObject height_texture_, shading_texture_;
};

}  // namespace sandstroke
