#include "cli/run_picture.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "io/run_file.h"
#include "render/change_picture.h"
#include "render/load_mesh.h"
#include "sim/scene_moisture.h"
#include "tool/tool_surface.h"

namespace sandstroke {
RunPainter::RunPainter(const RunFile& run, const ViewSettings& view, double contour_interval)
    : run_(run),
      scene_(run.scene()),
      renderer_(run.rows(), run.cols(), run.cell_size()),
      initial_(run.initial_bed()) {
  const CellRange stroke = view.name == ViewName::stroke ? stroke_cells() : CellRange{};
  subject_ = subject_of_change(initial_, last_surface(run).surface, stroke, view, contour_interval);
  subject_.shape = scene_.bed.shape;
  subject_.crumbs = slope_of_crumbs(scene_);
}

/// The cells where the hand took the tool below the starting surface. Empty without a trace.
CellRange RunPainter::stroke_cells() {
  if (!run_.has_trace()) return {};
  trace_ = run_.trace();
  std::vector<Eigen::Vector3d> tips;
  for (const TickRecord& tick : *trace_)
    if (!std::isnan(tick.level)) tips.push_back(tip_of(scene_.device, tick.hand.position));
  return cells_under(tips, tool_reach(scene_.tool), BedGeometry(run_.rows(), run_.cols(), run_.cell_size()),
                     initial_.highest());
}

Image RunPainter::draw(const HeightField& surface, std::optional<double> tool_time,
                       const std::optional<LoadSurface>& load) {
  subject_.tool = tool_time ? std::optional(tool_at(*tool_time)) : std::nullopt;
  if (subject_.tool && load) subject_.tool->load = std::make_shared<TriangleMesh>(load_mesh(*load));
  HeightGrid difference;
  if (subject_.view.style == RenderStyle::difference) difference = surface.grid() - initial_.grid();
  subject_.difference = &difference;
  return renderer_.render(surface, subject_);
}

ToolBody RunPainter::tool_at(double time) {
  if (!trace_) {
    if (!run_.has_trace())
      throw_input_error("{}: has no trace, so the position of the tool is unknown; add --no-tool",
                        run_.name());
    trace_ = run_.trace();
  }
  if (trace_->empty())
    throw_input_error("{}: has no stroke, so there is no tool to draw; add --no-tool", run_.name());
  const auto after = std::upper_bound(trace_->begin() + 1, trace_->end(), time,
                                      [](double at, const TickRecord& tick) { return at < tick.time; });
  const TickRecord& tick = *std::prev(after);
  return {tip_of(scene_.device, tick.device_position), scene_.tool.radius, mesh_as(tick.hand.orientation)};
}

std::shared_ptr<const TriangleMesh> RunPainter::mesh_as(const Eigen::Quaterniond& hand) {
  if (scene_.tool.shape == ToolShape::sphere) return nullptr;
  const Eigen::Matrix3d rotation = rotation_of(hand) * own_rotation(scene_.tool);
  if (!mesh_ || rotation != rotation_)
    mesh_ = std::make_shared<TriangleMesh>(turned(tool_surface(scene_.tool), rotation_ = rotation));
  return mesh_;
}

Image run_picture(const RunFile& run, const ViewSettings& view) {
  return RunPainter(run, view).draw(run.final_bed());
}

}  // namespace sandstroke
