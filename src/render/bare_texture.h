#pragma once

#include <memory>

#include "render/gl_objects.h"
#include "render/surface_textures.h"
#include "sand/ground.h"

namespace sandstroke {

/// Where no sand covers the floor of a bed, as a texture for the GPU. Red: the part of each cell that is bare
/// stone; green: that is the bare, level bottom of the bed. A cell counts as partly bare under a hundredth of
/// a cell of sand. Parts are softened over the cells beside, so that a stone's outline shows no steps.
/// Without a floor it holds nothing.
class BareTexture {
 public:
  /// Takes over the floor under a surface that `textures` has just taken over. anew: also cells that did not
  /// change. A context must be current.
  void update(const HeightField& surface, const SurfaceTextures& textures, bool anew);
  /// The ground whose floor is shown; null: none.
  const std::shared_ptr<const Ground>& ground() const { return ground_; }
  void bind(int unit) const;

 private:
  void upload(const CellRange& cells, const SurfaceTextures& textures);

  std::shared_ptr<const Ground> ground_, looked_at_;  // the one shown, and the last one given
  GlObject texture_;
  bool filtered_ = false;
};

}  // namespace sandstroke
