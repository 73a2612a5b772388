#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "sand/floor_surface.h"
#include "tool/tool_settings.h"

namespace sandstroke {

/// Finds how far a tool is in the floor of a bed: the least way [m] that frees it, along which a stiff floor
/// pushes it. At an upright side that is sideways, in a corner away from both sides. A sphere is exact on a
/// floor as FloorSurface has it. Any other tool is taken as points on its surface, about a cell apart: a peak
/// of the floor between them may reach into it by about slope change x cell / 8.
///
/// It takes the point of the tool that is deepest in the floor, moves the tool to the nearest position that
/// is free by all such points so far (half-spaces), and looks again. So the way changes continuously with the
/// position, unless the tool has as far to one side as to another one. A wall thinner than the tool may have
/// it come out beyond.
class FloorContact {
 public:
  /// cell_size [m] of the bed. A tool's own orientation counts; turn() changes it.
  FloorContact(const ToolSettings& tool, double cell_size);

  /// How the tool lies in the bed. A sphere does not turn.
  void turn(const Eigen::Matrix3d& rotation);
  /// The least way out [m] of the bed's floor for a tool with its tip here [m]; 0 if it is free. Costs
  /// nothing on a bed without ground, and hardly anything where no floor is as high as the tool's lowest
  /// point.
  Eigen::Vector3d way_out(const HeightField& bed, const Eigen::Vector3d& tip);

  void visit_state(StateVisitor& state);

 private:
  /// The least way out of the deepest point alone, once the tool has moved by `moved`; 0: all are free, to
  /// `enough` [m].
  Eigen::Vector3d deepest(const Eigen::Vector3d& tip, const Eigen::Vector3d& moved, double enough) const;

  double cell_size_;
  Eigen::Matrix3d rotation_ = Eigen::Matrix3d::Identity();
  std::optional<double> sphere_radius_;               // m
  std::vector<Eigen::Vector3d> own_points_, points_;  // m from the tip, of the tool unturned and as it lies
  double reach_ = 0.0, lowest_ = 0.0;                 // m, of these, from the axis and above the tip
  FloorSurface floor_;
};

}  // namespace sandstroke
