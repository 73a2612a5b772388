#include "sim/check_tool.h"

#include <algorithm>

#include "core/error.h"
#include "sim/tool_fit.h"

namespace sandstroke {
namespace {

/// Error: input, where the walls of a shovel or a bowl leave no room, or are so thin that sand would run
/// through them.
void check_walls(const Scene& scene, const std::string& name) {
  const ToolSettings& tool = scene.tool;
  if (tool.shape != ToolShape::shovel && tool.shape != ToolShape::bowl) return;
  const bool is_bowl = tool.shape == ToolShape::bowl;
  const double least = is_bowl ? std::min(tool.radius, tool.height)
                               : std::min({tool.size.x(), 0.5 * tool.size.y(), tool.size.z()});
  if (!(tool.thickness < least))
    throw_input_error("{}: tool.thickness = {:g} m leaves no room in the {}; take less than {:g} m", name,
                      tool.thickness, is_bowl ? "bowl" : "shovel", least);
  constexpr double least_cells = 1.5;
  if (tool.carries && tool.thickness < least_cells * scene.bed.cell_size())
    throw_input_error(
        "{}: tool.thickness = {:g} m is {:.2g} cells: sand would run through such a wall; take {:.3g} m or "
        "more, or smaller cells",
        name, tool.thickness, tool.thickness / scene.bed.cell_size(), least_cells * scene.bed.cell_size());
}

/// Error: input, where a tool that carries sand does not go with other settings.
void check_carrying(const Scene& scene, const std::string& name) {
  if (!scene.tool.carries) return;
  const PluginLawSettings& own = scene.plugin_laws;
  for (const auto& [key, law] :
       {std::pair("relaxation", &own.relaxation), std::pair("displacement", &own.displacement)})
    if (!law->empty())
      throw_input_error(
          "{}: model.{} = \"{}\" is a plugin law, which knows no tool.carries; remove one of the two", name,
          key, *law);
  if (scene.relaxation.law == RelaxationLaw::paper && takes_super_steps(scene.relaxation.method))
    throw_input_error(
        "{}: relaxation.law = \"paper\" goes with relaxation.method = \"passes\" or \"plain\" where sand "
        "lies on a tool (tool.carries); take one of them, or another law",
        name);
}

}  // namespace

void check_tool(const Scene& scene, const std::string& name) {
  const bool is_sphere = scene.tool.shape == ToolShape::sphere;
  if (!is_sphere && scene.plugin_laws.displacement.empty() && scene.displacement.deposit != Deposit::outward)
    throw_input_error(
        "{}: displacement.deposit = \"ring\" and \"ahead\" need a sphere; for any other tool.shape set "
        "model.preset = \"accurate\", or displacement.deposit = \"outward\"",
        name);
  if (scene.tool.shape == ToolShape::mesh && scene.tool.file.empty())
    throw_input_error("{}: tool.file is missing; name a mesh (.stl)", name);
  check_walls(scene, name);
  check_carrying(scene, name);
  if (scene.tool.shape == ToolShape::rake && scene.tool.teeth > 1 &&
      scene.tool.spacing < 2.0 * scene.tool.radius)
    throw_input_error(
        "{}: tool.spacing = {} m: teeth of {} m in diameter overlap, and what they share would count twice; "
        "set a spacing of {} m or more, a smaller tool.radius, or tool.shape = \"plate\"",
        name, scene.tool.spacing, 2.0 * scene.tool.radius, 2.0 * scene.tool.radius);
  if (scene.stroke) check_tool_fits(scene, name);
}

}  // namespace sandstroke
