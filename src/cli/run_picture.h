#pragma once

#include <optional>

#include "io/run_file.h"
#include "picture/image.h"
#include "picture/view.h"
#include "render/height_field_renderer.h"
#include "sim/scene.h"

namespace sandstroke {

/// Draws the surfaces of one run, all in the same view and on the same colour scale: that of the initial and
/// the last surface together. Camera and box follow from the scene alone: the bed, its initial surface and,
/// in view stroke, the way of the hand through it (of a run without a trace: the whole bed). So pictures of
/// runs that differ only in what the sand did can be laid over one another. Style difference shows what
/// changed since the initial surface.
class RunPainter {
 public:
  /// contour_interval [m]: 0 = a round one. Error: input or io, as RunFile and HeightFieldRenderer.
  RunPainter(const RunFile& run, const ViewSettings& view, double contour_interval = 0.0);

  /// The tool is drawn where it is at `tool_time` [s] (the last tick before it), if that is given. Error:
  /// input, where the run holds no trace.
  Image draw(const HeightGrid& surface, std::optional<double> tool_time = std::nullopt);

 private:
  CellRange stroke_cells();
  ToolBody tool_at(double time);
  std::shared_ptr<const TriangleMesh> mesh_as(const Eigen::Quaterniond& hand);

  const RunFile& run_;
  Scene scene_;
  HeightFieldRenderer renderer_;  // before the surfaces: it refuses beds that cannot be drawn
  HeightGrid initial_;
  RenderSubject subject_;
  std::shared_ptr<const TriangleMesh> mesh_;  // of any tool but the sphere,
  Eigen::Matrix3d rotation_;                  // turned like this
  std::optional<std::vector<TickRecord>> trace_;
};

/// The final surface of a run.
Image run_picture(const RunFile& run, const ViewSettings& view);

}  // namespace sandstroke
