#include "sand/tool.h"

#include "sand/shaped_tool.h"
#include "sand/sphere_tool.h"

namespace sandstroke {

double Tool::displace(HeightField& bed, double tip_height, const Eigen::Vector3d& motion,
                      const DisplacementSettings& settings) {
  if (footprint_.cells().empty()) return 0.0;
  const double moved = displace_in_footprint(bed, tip_height, motion, settings);
  if (moved > 0.0) footprint_.write_flagged(bed);
  return moved * bed.cell_area();
}

void Tool::meet(const HeightField& bed, double tip_height) {
  if (footprint_.cells().empty()) return;
  carve_only(tip_height);
  footprint_.read_heights(bed);
}

void Tool::make_walls(HeightField& bed) {
  if (!footprint_.cells().empty()) cover();
  footprint_.make_walls(bed);
}

std::unique_ptr<Tool> make_tool(const ToolSettings& settings) {
  if (settings.shape == ToolShape::sphere) return std::make_unique<SphereTool>(settings);
  return std::make_unique<ShapedTool>(settings);
}

}  // namespace sandstroke
