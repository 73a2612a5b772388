#include "render/redraw.h"

#include <algorithm>
#include <cmath>

#include "render/shaders.h"
#include "sand/cell_ranges.h"

namespace sandstroke {
namespace {

/// True where two pictures of the same surface would differ only by the tool.
bool same_but_tool(const PictureState& a, const PictureState& b) {
  return a.camera.to_clip == b.camera.to_clip && a.camera.eye == b.camera.eye &&
         a.camera.forward == b.camera.forward && a.camera.orthographic == b.camera.orthographic &&
         a.camera.scale == b.camera.scale && a.sun == b.sun && a.start == b.start &&
         a.wall_radius == b.wall_radius && a.style == b.style && a.box == b.box && a.crumbs == b.crumbs &&
         a.background == b.background && a.tile_levels == b.tile_levels && a.ground == b.ground;
}

/// Boxes around the tool itself, and around the sand whose light it changes (past_tool() of the shader). None
/// where the sun stands so low that the tool's shadow has no end.
std::vector<Eigen::AlignedBox3d> boxes_of(const ToolBody& tool, const Sun& sun,
                                          const SurfaceTextures& surface) {
  const Eigen::Vector3d centre = tool.centre(), up = sun.direction();
  const double low = surface.lowest(), high = surface.highest(), radius = tool.radius;
  const auto around = [](const Eigen::Vector3d& position, double reach) {
    return Eigen::AlignedBox3d(position.array() - reach, position.array() + reach);
  };
  const auto on_sand = [&](Eigen::AlignedBox3d box) {
    box.min().z() = low;
    box.max().z() = high;
    return box;
  };
  if (tool.mesh) return {tool.box()};  // a mesh throws no shadow
  if (up.z() < 0.05) return {};
  // The length along the axis at which the shadow, widening by 0.03 of it, has passed the lowest sand.
  const double length = std::max(0.0, centre.z() - low + 1.04 * radius) / (up.z() - 0.03);
  const double width = 1.04 * radius + 0.03 * length;
  Eigen::AlignedBox3d shadow = around(centre, width);
  shadow.extend(around(centre - length * up, width));
  return {around(centre, radius), on_sand(shadow), on_sand(around(centre, shaders::tool_reach * radius))};
}

}  // namespace

double widest_pixel(const SurfaceTextures& surface, int tile, const TileDetail& detail,
                    const Camera& camera) {
  const BedGeometry& bed = surface.bed();
  const double whole = bed.cell_size() * std::max(bed.rows(), bed.cols());
  const double widest = camera.widest_pixel(surface.bounds(tile, detail), detail.steepest / bed.cell_size());
  return std::exp2(std::ceil(std::log2(std::min(whole, widest))));
}

PixelRect changed_pixels(const PictureState& before, const PictureState& now, const SurfaceTextures& surface,
                         const PixelRect& picture) {
  if (!same_but_tool(before, now) || now.style != RenderStyle::sand) return picture;
  const BedGeometry& bed = surface.bed();
  PixelRect changed;
  const auto add = [&](const Eigen::AlignedBox3d& box) {
    changed.extend(now.camera.pixels_of(box, picture.right, picture.top));
  };
  if (before.tool != now.tool) {
    for (const std::optional<ToolBody>& tool : {before.tool, now.tool}) {
      if (!tool) continue;
      const std::vector<Eigen::AlignedBox3d> boxes = boxes_of(*tool, now.sun, surface);
      if (boxes.empty()) return picture;
      for (const Eigen::AlignedBox3d& box : boxes) add(box);
    }
  }
  for (const SurfaceTextures::Change& change : surface.changes()) {
    const TileDetail &was = change.before, &is = surface.detail(change.tile);
    const CellRange patch = surface.patch(change.tile);
    const auto level = [&](const TileDetail& detail) {
      return level_of_detail(detail, bed.cell_size(),
                             now.camera.pixels_per_metre(surface.bounds(change.tile, detail)));
    };
    const auto widest = [&](const TileDetail& detail) {
      return widest_pixel(surface, change.tile, detail, now.camera);
    };
    const double was_bottom = skirt_bottom(was, bed.cell_size()),
                 is_bottom = skirt_bottom(is, bed.cell_size());
    const bool same_triangles =
        level(was) == level(is) && was_bottom == is_bottom && widest(was) == widest(is);
    // All triangles that have a corner in the cells that changed.
    const CellRange part = same_triangles ? common(grown(change.cells, 1 << level(is)), patch) : patch;
    add(box_over(bed, part, std::min(was_bottom, is_bottom), std::max(was.highest, is.highest)));
  }

  // A pixel's shading is a mean over an area: where it changed, the pixels beside change, too.
  const CellRange& shaded = surface.shaded();
  if (shaded.empty()) return changed;
  for (int tile = 0; tile < bed.tile_count(); ++tile) {
    const double cells = widest_pixel(surface, tile, surface.detail(tile), now.camera) / bed.cell_size();
    // The reach in the coarser of two levels, whose texels are up to two pixels wide: one and a half texels
    // to each side, and one more, because texels of an odd bed's levels lie beside the cells they are means
    // of.
    const int reach = static_cast<int>(std::ceil(5.0 * std::max(1.0, cells))) + 1;
    const CellRange part = common(grown(shaded, reach), surface.patch(tile));
    if (part.empty()) continue;
    const TileDetail& detail = surface.detail(tile);
    add(box_over(bed, part, skirt_bottom(detail, bed.cell_size()), detail.highest));
  }
  return changed;
}

}  // namespace sandstroke
