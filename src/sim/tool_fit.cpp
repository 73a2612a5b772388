#include "sim/tool_fit.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/elementary.h"
#include "core/error.h"
#include "rules/filter.h"
#include "sand/room_on_tool.h"
#include "tool/tool_surface.h"
#include "tool/tool_width.h"

namespace sandstroke {
namespace {

/// The least width [cells]. A sphere of less leaves nothing, or half its depth, as the cells lie. A cell at
/// the edge of any other tool is as deep as those in its middle: a furrow of 1.5 cells is 13 to 99 % too
/// large, of three cells 9 to 54 %. A rake's furrows are within 10 % from eight cells on.
double least_cells(ToolShape shape) {
  return shape == ToolShape::sphere ? 2.0 : shape == ToolShape::rake ? 8.0 : 3.0;
}
/// From here on [cells] a furrow is within a few percent.
constexpr double fine = 10.0;
constexpr double of_corners = 1e-3;  // the corners of round shapes lie on the circle, their sides inside

bool is_sphere(const Scene& scene) { return scene.tool.shape == ToolShape::sphere; }

bool is_known(const Scene& scene) { return scene.tool.shape != ToolShape::mesh || scene.tool.mesh; }

/// bed.cells in which a width [m] has so many cells; empty if no bed may have as many. Cells must be square,
/// so the numbers keep their ratio.
std::string cells_for(const BedSettings& bed, double width, double cells) {
  const int square = std::gcd(bed.cols, bed.rows);  // cells along the largest squares that tile the bed
  const double along = std::ceil(square * bed.cell_size() * cells / width * (1.0 - of_corners)),
               cols = bed.cols / square * along, rows = bed.rows / square * along;
  if (!(std::max(cols, rows) <= BedGeometry::most_cells)) return "";
  return fmt::format("bed.cells = [{:.0f}, {:.0f}]", cols, rows);
}

void check_size(const Scene& scene, const std::string& name) {
  const BedSettings& bed = scene.bed;
  const double reach = is_sphere(scene) ? filter::reach(scene.tool.radius) : tool_reach(scene.tool);
  if (!(2.0 * reach > std::min(bed.width, bed.depth))) return;
  if (is_sphere(scene))
    throw_input_error(
        "{}: tool.radius = {} m: the tool and its rampart ({:.3g} m) do not fit the bed ({} m by {} m); take "
        "a smaller radius",
        name, scene.tool.radius, 2.0 * reach, bed.width, bed.depth);
  constexpr double millimetre = 1e-3;
  const bool may_be_in_millimetres =
      scene.tool.shape == ToolShape::mesh && scene.tool.scale == 1.0 &&
      millimetre * narrowest_width(scene.tool, std::numeric_limits<double>::infinity()) >=
          least_cells(scene.tool.shape) * bed.cell_size();
  throw_input_error(
      "{}: the tool is {:.3g} m wide and does not fit the bed ({} m by {} m); take a smaller one{}", name,
      2.0 * reach, bed.width, bed.depth,
      may_be_in_millimetres
          ? fmt::format(
                "; is the mesh in millimetres? Then set tool.scale = 0.001, which makes it {:.3g} mm wide",
                2.0 * reach)
          : "");
}

}  // namespace

const char* width_key(const ToolSettings& tool) {
  switch (tool.shape) {
    case ToolShape::box:
    case ToolShape::shovel:
      return "tool.size";
    case ToolShape::plate:
      return tool.width < tool.thickness ? "tool.width" : "tool.thickness";
    case ToolShape::mesh:
      return "tool.scale";
    default:
      return "tool.radius";
  }
}

void check_tool_fits(const Scene& scene, const std::string& name, double depth) {
  if (!is_known(scene)) return;
  check_size(scene, name);
  const double least = least_cells(scene.tool.shape);
  const double width = narrowest_width(scene.tool, depth), cells = width / scene.bed.cell_size();
  if (!(cells < least * (1.0 - of_corners))) return;
  const double whole = narrowest_width(scene.tool, std::numeric_limits<double>::infinity());
  const std::string where =
      whole > width * (1.0 + of_corners) ? fmt::format(" up to its depth of {:.4g} m", depth) : "";
  const char* key = width_key(scene.tool);
  if (!(width > 0.0))
    throw_input_error("{}: the tool has no width{}; take a tool with a wider tip, or a larger {}", name,
                      where, key);
  const std::string finer = cells_for(scene.bed, width, least);
  throw_input_error(
      "{}: the tool is only {:.3g} cells wide at its narrowest{} ({:.4g} m), and a furrow needs {:g} cells; "
      "take {}a larger {}{}",
      name, cells, where, width, least, finer.empty() ? "a smaller bed.size, or " : finer + " or more, or ",
      key,
      scene.tool.shape == ToolShape::mesh && scene.tool.scale < 1.0
          ? fmt::format(" (is the mesh in metres? Then set tool.scale = 1; it is {:g})", scene.tool.scale)
          : "");
}

double expected_furrow_error(ToolShape shape, double cells) {
  const double per_half = 0.5 * cells;
  return shape == ToolShape::sphere ? 0.7 * elementary::pow(per_half, -1.6)
                                    : 1.1 * elementary::pow(per_half, -1.7);
}

std::string coarse_tool_warning(const Scene& scene, double depth) {
  if (!is_known(scene) || !(depth > 0.0)) return "";
  const double width = narrowest_width(scene.tool, depth), cells = width / scene.bed.cell_size();
  if (!(cells < fine * (1.0 - of_corners))) return "";
  const std::string finer = cells_for(scene.bed, width, fine);
  return fmt::format(
      "the tool is {:.3g} cells wide at its narrowest: its furrow may be off by up to {:.0f} %, and by "
      "{:.0f} % with ten{}; --estimate-error says more",
      cells, 100.0 * expected_furrow_error(scene.tool.shape, cells),
      100.0 * expected_furrow_error(scene.tool.shape, fine), finer.empty() ? "" : ", " + finer);
}

std::string leaking_tool_warning(const Scene& scene) {
  if (!scene.tool.carries || !is_known(scene)) return "";
  constexpr double holds = 0.7;  // of the room within all walls; what no wall holds has the same in both
  const TriangleMesh surface = turned(tool_surface(scene.tool), own_rotation(scene.tool));
  const UpperSide upper(surface, scene.bed.cell_size());
  const RoomOnTool room = room_on_tool(upper, surface, talus_slope(scene.relaxation.talus_angle));
  if (!(room.in_cells < holds * room.within_edges)) return "";
  return fmt::format(
      "tool.carries: walls of the tool are thinner than a cell ({:.3g} mm), and sand runs through them: it "
      "holds up to {:.3g} cm^3, of {:.3g} cm^3 within its walls; take more bed.cells, or thicker walls",
      1e3 * scene.bed.cell_size(), 1e6 * room.in_cells, 1e6 * room.within_edges);
}

}  // namespace sandstroke
