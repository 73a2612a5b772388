#pragma once

#include <optional>

#include "io/run_file.h"
#include "picture/image.h"
#include "picture/view.h"
#include "render/height_field_renderer.h"
#include "sim/scene.h"

namespace sandstroke {

/// Draws the surfaces of one run in the same view and on one colour scale, which covers the initial and the
/// last surface. Camera and box depend on the scene alone: the bed, its initial surface and, in view
/// `stroke`, the hand's path (without a trace: the whole bed). So pictures of runs that differ only in their
/// sand fit over one another. Style `difference` shows the change since the initial surface.
class RunPainter {
 public:
  /// contour_interval [m]: 0 chooses a round one. Error: input or io, as in RunFile and HeightFieldRenderer.
  RunPainter(const RunFile& run, const ViewSettings& view, double contour_interval = 0.0);

  /// Draws a surface and, if given `tool_time` [s], the tool at that time (at the last tick before it), with
  /// the sand on it, if given. Error: input, if the run has no trace.
  Image draw(const HeightField& surface, std::optional<double> tool_time = std::nullopt,
             const std::optional<LoadSurface>& load = std::nullopt);

 private:
  CellRange stroke_cells();
  ToolBody tool_at(double time);
  std::shared_ptr<const TriangleMesh> mesh_as(const Eigen::Quaterniond& hand);

  const RunFile& run_;
  Scene scene_;
  HeightFieldRenderer renderer_;  // declared before the surfaces: it refuses beds that cannot be drawn
  HeightField initial_;
  RenderSubject subject_;
  std::shared_ptr<const TriangleMesh> mesh_;  // of any tool but the sphere
  Eigen::Matrix3d rotation_;                  // the orientation of mesh_
  std::optional<std::vector<TickRecord>> trace_;
};

/// The final surface of a run.
Image run_picture(const RunFile& run, const ViewSettings& view);

}  // namespace sandstroke
