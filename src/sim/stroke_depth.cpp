#include "sim/stroke_depth.h"

#include <spdlog/fmt/fmt.h>

namespace sandstroke {

DeepestPlace deepest_place(const Scene& scene, const HeightField& bed, const Stroke& stroke) {
  DeepestPlace deepest;
  for (std::size_t i = 0; i < stroke.size(); ++i) {
    if (!stroke.pen_down(i)) continue;
    const Eigen::Vector3d tip = tip_of(scene.device, stroke.position[i]);
    const double depth = bed.height_at(tip.x(), tip.y()) - tip.z();
    if (depth > deepest.depth) deepest = {depth, stroke.time[i]};
  }
  return deepest;
}

std::string depth_warning(const Scene& scene, const HeightField& bed, const Stroke& stroke,
                          const std::string& name) {
  constexpr double most_radii = 20.0;  // strokes in sand stay within a few
  const DeepestPlace deepest = deepest_place(scene, bed, stroke);
  const double radii = deepest.depth / scene.tool.radius;
  if (!(radii > most_radii)) return "";
  return fmt::format(
      "{}: goes {:.4g} m deep into the sand (at {:.3f} s), {:.0f} times tool.radius = {:g} m; lengths are "
      "metres: check stroke.depth, stroke.offset and stroke.scale, and the depths in the stroke itself",
      name, deepest.depth, deepest.time, radii, scene.tool.radius);
}

}  // namespace sandstroke
