#include "measure/stroke_depth.h"

#include <spdlog/fmt/fmt.h>

#include <cmath>

#include "sim/tool_fit.h"
#include "tool/tool_surface.h"

namespace sandstroke {

DeepestPoint deepest_point(const Scene& scene, const HeightField& bed, const Stroke& stroke) {
  DeepestPoint deepest;
  for (std::size_t i = 0; i < stroke.size(); ++i) {
    if (!stroke.pen_down(i)) continue;
    const Eigen::Vector3d tip = tip_of(scene.device, stroke.position[i]);
    const double level = bed.height_at(tip.x(), tip.y());
    const double depth = (stroke.follows_sand && !std::isnan(level) ? 0.0 : level) - tip.z();
    if (depth > deepest.depth) deepest = {depth, stroke.time[i]};
  }
  return deepest;
}

void check_tool_in_stroke(const Scene& scene, const HeightField& bed, const Stroke& stroke,
                          const std::string& name) {
  const double depth = deepest_point(scene, bed, stroke).depth;
  if (depth > 0.0) check_tool_fits(scene, name, depth);
}

std::string untouched_text(const Scene& scene, const RunResult& result) {
  constexpr const char* tracing =
      "for a tracing on a table set stroke.plane = \"fit\" and stroke.depth = 0.004";
  if (!(result.stroke.played > 0.0))
    return "the tool never touched the sand: the pen is never down in the stroke; see its gaps and pen "
           "states with sandstroke stroke info";
  if (std::isinf(result.nearest))
    return fmt::format(
        "the tool never touched the sand: it is down only outside the bed, {:.4g} mm or more beyond its "
        "edge; set stroke.place = \"centre\"; {}",
        1e3 * result.least_beside, tracing);
  const double away = -result.nearest, depth = scene.stroke->placement.depth;
  return fmt::format(
      "the tool never touched the sand: it stayed {:.4g} mm above it (nearest at {:.3f} s); set stroke.depth "
      "above {:.4g} m (it is {:.4g} m), or lower stroke.offset; {}",
      1e3 * std::abs(away), result.nearest_time, depth + away / scene.device.scale, depth, tracing);
}

std::string depth_warning(const Scene& scene, const HeightField& bed, const Stroke& stroke,
                          const std::string& name) {
  constexpr double most_radii = 20.0;  // strokes in sand stay within a few
  const DeepestPoint deepest = deepest_point(scene, bed, stroke);
  const double reach = tool_reach(scene.tool), radii = deepest.depth / reach;
  if (!(radii > most_radii)) return "";
  return fmt::format(
      "{}: goes {:.4g} m deep into the sand (at {:.3f} s), {:.0f} times the tool's reach of {:g} m; lengths "
      "are "
      "metres: check stroke.depth, stroke.offset and stroke.scale, and the depths in the stroke itself",
      name, deepest.depth, deepest.time, radii, reach);
}

}  // namespace sandstroke
