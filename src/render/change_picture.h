#pragma once

#include <memory>
#include <optional>

#include "render/height_field_renderer.h"

namespace sandstroke {

/// How surfaces between an initial and a last one [m] are shown, all with one camera, which the initial one
/// sets, and on one scale of colours: that of the two together. stroke: what view stroke frames.
/// contour_interval [m]: 0 = a round one.
RenderSubject subject_of_change(const HeightGrid& initial, const HeightGrid& last, const CellRange& stroke,
                                const ViewSettings& view, double contour_interval = 0.0);

/// Draws the last surfaces of runs, one after the other; beds of one size cost the graphics system's start
/// only once. For one thread.
class ChangePainter {
 public:
  /// Error: input, io, as HeightFieldRenderer.
  Image draw(const HeightField& initial, const HeightField& last, const CellRange& stroke,
             const ViewSettings& view);

 private:
  std::unique_ptr<HeightFieldRenderer> renderer_;
  std::optional<BedGeometry> bed_;  // that it draws
};

}  // namespace sandstroke
