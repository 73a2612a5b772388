#pragma once

#include "render/camera.h"
#include "render/surface_textures.h"

namespace sandstroke {

/// Everything that a picture depends on, besides the surface and the picture's size.
struct PictureState {
  Camera camera;
  Sun sun;
  StartHeights start;        ///< of the box
  double wall_radius = 0.0;  ///< m, of a round bed; 0: the bed is not round
  RenderStyle style = RenderStyle::sand;
  bool box = true;
  double crumbs = 0.0;
  std::optional<std::array<double, 3>> background;
  std::vector<int> tile_levels;
  std::optional<ToolBody> tool;
  std::shared_ptr<const Ground> ground;  ///< whose floor is seen where it is bare; null: none
};

/// A bound on how far [m] the point under a pixel moves, from one pixel to the next, on the sand of a tile of
/// this detail. Shading is never a mean over more, so changes elsewhere cannot reach the tile. It is a power
/// of two, at most about the bed's side, so it seldom changes.
double widest_pixel(const SurfaceTextures& surface, int tile, const TileDetail& detail, const Camera& camera);

/// A rectangle of all pixels that differ from the picture before, given what the surface's last update
/// changed. It is the whole picture, unless the style is sand, and only sand and tool have moved.
PixelRect changed_pixels(const PictureState& before, const PictureState& now, const SurfaceTextures& surface,
                         const PixelRect& picture);

}  // namespace sandstroke
