#pragma once

#include <memory>
#include <optional>

#include "render/height_field_renderer.h"

namespace sandstroke {

/// How to show surfaces between an initial and a last one [m]. The initial one sets the camera of all. Their
/// colour scale is that of both together. stroke: the cells that view stroke frames. contour_interval [m]: 0
/// = a round one.
RenderSubject subject_of_change(const HeightField& initial, const HeightField& last, const CellRange& stroke,
                                const ViewSettings& view, double contour_interval = 0.0);

/// Draws the last surfaces of runs, one after the other. Beds of one size start the graphics system only
/// once. For one thread.
class ChangePainter {
 public:
  /// crumbs: as in RenderSubject. Error: input, io, as HeightFieldRenderer.
  Image draw(const HeightField& initial, const HeightField& last, const CellRange& stroke,
             const ViewSettings& view, double crumbs);

 private:
  std::unique_ptr<HeightFieldRenderer> renderer_;
  std::optional<BedGeometry> bed_;  // that renderer_ draws
};

}  // namespace sandstroke
