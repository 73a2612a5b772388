#include "sim/check_inside.h"

#include <spdlog/fmt/fmt.h>

#include <Eigen/Geometry>
#include <string>

#include "core/error.h"

namespace sandstroke {
namespace {

/// A sentence on where a stroke draws, and what brings it onto the bed.
std::string way_onto_the_bed(const Stroke& stroke, const Scene& scene) {
  Eigen::AlignedBox2d drawn;
  for (std::size_t i = 0; i < stroke.size(); ++i)
    if (stroke.pen_down(i)) drawn.extend(tip_of(scene.device, stroke.position[i]).head<2>());
  const Eigen::Vector2d bed(scene.bed.width, scene.bed.depth);
  const bool too_large = (drawn.sizes().array() > bed.array()).any();
  return fmt::format(
      "it draws from x = {:.4g} to {:.4g} m and y = {:.4g} to {:.4g} m, and the bed ends at x = {:.4g} m and "
      "y = {:.4g} m; set stroke.place = \"centre\"{}",
      drawn.min().x(), drawn.max().x(), drawn.min().y(), drawn.max().y(), 0.5 * bed.x(), 0.5 * bed.y(),
      too_large ? " and stroke.fit = 0.8 (or change stroke.scale; 0.001 converts millimetres to metres)"
                : ", or change stroke.offset, stroke.scale or bed.size");
}

}  // namespace

void check_inside(const Stroke& stroke, const Scene& scene, const HeightField& bed) {
  const double highest = stroke.follows_sand ? 0.0 : bed.highest();
  for (std::size_t i = 0; i < stroke.size(); ++i) {
    const Eigen::Vector3d tip = tip_of(scene.device, stroke.position[i]);
    const double beyond = bed.beyond_edge(tip.x(), tip.y());
    if (beyond > 0.0 && stroke.pen_down(i) && tip.z() < highest)
      throw_input_error(
          "the stroke enters the sand outside the bed: at {:.3f} s it is {:.4g} mm beyond the bed's edge, at "
          "x = {:.4g} m, y = {:.4g} m; {}",
          stroke.time[i], 1e3 * beyond, tip.x(), tip.y(), way_onto_the_bed(stroke, scene));
  }
}

}  // namespace sandstroke
