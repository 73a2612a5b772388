#pragma once

#include <Eigen/Core>
#include <memory>
#include <string>

#include "rules/filter.h"
#include "tool/triangle_mesh.h"

namespace sandstroke {

/// A mesh is read from a file. The others are made by formula (tool_surface.h).
enum class ToolShape { sphere, cylinder, cone, box, plate, rake, shovel, bowl, mesh };

/// The tool's body in its own frame: its tip at the origin, z up.
struct ToolSettings {
  double radius = 0.01;  ///< m, of the sphere (paper 4.1), cylinder, cone (at its top), a rake's teeth
  ToolProfile profile = ToolProfile::paper;  ///< of the sphere
  bool solid = false;    ///< while it touches the sand, the cells under it are walls in relaxation
  bool carries = false;  ///< sand above its upper side lies on it and goes with it
  ToolShape shape = ToolShape::sphere;
  double height = 0.04;                       ///< m, of cylinder, cone, plate, bowl, a rake's teeth
  Eigen::Vector3d size = {0.02, 0.02, 0.04};  ///< m, of the box and the shovel
  double width = 0.1;                         ///< m, of the plate, along y
  double thickness = 0.004;                   ///< m, of the plate, along x; of the walls of shovel and bowl
  int teeth = 5;                              ///< of the rake, in a row along y
  double spacing = 0.03;                      ///< m, between the teeth's axes
  std::string file = {};                      ///< of the mesh
  double scale = 1.0;                         ///< m per unit of length in that file
  Eigen::Vector3d orientation = Eigen::Vector3d::Zero();  ///< deg: turned about x, then about y, then about z
  std::shared_ptr<const TriangleMesh> mesh = nullptr;  ///< shape = mesh: that file's, in m (null: not read)
};

}  // namespace sandstroke
