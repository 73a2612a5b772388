// An STL file: what is taken for a tool carves, feels, and loses no sand.
#include <cmath>

#include "fuzz.h"
#include "io/mesh_file.h"
#include "sand/resistive_force.h"
#include "sand/tool.h"
#include "tool/tool_surface.h"

using namespace sandstroke;

namespace {

void carve(const ToolSettings& settings) {
  const double reach = std::max(tool_reach(settings), 1e-4), cell = reach / 8.0;
  HeightField bed(64, 64, cell);
  const auto made = make_tool(settings);
  Tool& tool = *made;
  ResistiveForce force(tool_surface(settings), cell);
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d motion(cell, 0.0, -0.5 * cell), tip = (i + 1) * motion;
    tool.place(bed, tip.x(), tip.y());
    tool.displace(bed, tip.z(), motion, {Deposit::outward});
    tool.read_heights(bed);
    require(force.feel(bed, tool.footprint(), tip, motion, {}).force.allFinite());
  }
  require(bed.grid().allFinite());
  require(std::abs(bed.volume()) < 1e-9 * 4096.0 * cell * cell * reach);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try_input([&] {
    ToolSettings tool;
    tool.shape = ToolShape::mesh;
    tool.mesh = std::make_shared<TriangleMesh>(
        parse_mesh(std::string(reinterpret_cast<const char*>(data), size), 1.0, "tool.stl"));
    require(enclosed_volume(*tool.mesh) > 0.0);
    carve(tool);
  });
  return 0;
}
