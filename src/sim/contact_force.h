#pragma once

#include <optional>

#include "sim/scene.h"
#include "sim/tool_force.h"

namespace sandstroke {

/// The force of the sand on the tool where force.law is not the paper's: of the contact itself.
/// - rft: resistive force theory over the tool's surface (ResistiveForce).
/// - archimedes: 0.87574 xi V upwards at the centroid of V, which is what lies below the sand's plane (Kang,
///   Feng, Liu, Blumenfeld, Nature Communications 9, 2018, as the theory gives it for a plate), and no drag;
///   it grows over the yield way as the tool sinks, and goes as it rises.
class ContactForce : public ToolForce {
 public:
  /// Elements are about a cell large. The scene's law is not the paper's.
  ContactForce(const Scene& scene, double cell_size);

  Wrench feel(const ToolInSand& touch) override;
  void lift() override;
  void turn(const Eigen::Matrix3d& rotation) override { resistive_.turn(rotation); }

 private:
  Wrench archimedes(const Eigen::Vector3d& tip, const SandPlane& plane, double sinks);
  VolumeBelow volume_below(const Eigen::Vector3d& tip, const SandPlane& plane) const;

  ForceLaw law_;
  SandStrength sand_;
  std::optional<double> sphere_radius_;  // m
  ResistiveForce resistive_;
  double sunk_ = 0.0;  // yield ways, 0 to 1
};

}  // namespace sandstroke
