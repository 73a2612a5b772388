#pragma once

#include <cstdint>
#include <memory>

#include "picture/image.h"
#include "render/render_subject.h"

namespace sandstroke {

/// How much the last picture drew.
struct RenderCounters {
  int tiles_changed = 0;       ///< computed and uploaded again
  std::int64_t pixels = 0;     ///< drawn again; all others are as before
  int tiles_drawn = 0;         ///< in those pixels
  std::int64_t triangles = 0;  ///< of the sand
};

/// Checks that the graphics system can draw a bed of this size. It gives the errors of HeightFieldRenderer's
/// constructor, but takes no memory for the bed.
void check_drawable(int rows, int cols);

/// Draws beds of one size, off screen, on the CPU. What it keeps from picture to picture only saves time: a
/// picture depends on surface and subject alone, to the bit.
///
/// The bed is drawn tile by tile, each at a level of detail that suits its size in the picture, down to
/// triangles of two pixels; shading always comes from all cells. Drawing takes single precision: 1e-7 of the
/// height.
class HeightFieldRenderer {
 public:
  /// cell_size [m]. Error: input, where a side of the bed is out of the limits of the graphics system (2 to
  /// 16384 cells with Mesa); io, where there is no graphics system.
  HeightFieldRenderer(int rows, int cols, double cell_size);
  ~HeightFieldRenderer();

  /// The picture, subject.view.width x height. Error: input, where the surface has another shape or
  /// subject.view is out of range; io, from the graphics system.
  Image render(const HeightField& surface, const RenderSubject& subject);

  const RenderCounters& counters() const;

 private:
  class Drawing;
  std::unique_ptr<Drawing> drawing_;
};

}  // namespace sandstroke
