#pragma once

#include "render/camera.h"
#include "render/surface_textures.h"

namespace sandstroke {

/// All that a picture depends on besides the surface and its own size.
struct PictureState {
  Camera camera;
  Sun sun;
  StartHeights start;        ///< the box
  double wall_radius = 0.0;  ///< m, of a round bed; 0: the bed is not round
  RenderStyle style = RenderStyle::sand;
  bool box = true;
  std::optional<std::array<double, 3>> background;
  std::vector<int> tile_levels;
  std::optional<ToolBody> tool;
};

/// A bound on how far [m] the sand of a tile of this detail moves under a pixel, from one pixel to the next:
/// its shading is never a mean over more, so that what changes elsewhere cannot reach it. A power of two, at
/// most about the bed, so that it seldom changes.
double widest_pixel(const SurfaceTextures& surface, int tile, const TileDetail& detail, const Camera& camera);

/// Holds all pixels that differ from the picture before, given what the surface's last update changed: all of
/// the picture's, unless it is of sand, and only sand and tool have moved.
PixelRect changed_pixels(const PictureState& before, const PictureState& now, const SurfaceTextures& surface,
                         const PixelRect& picture);

}  // namespace sandstroke
