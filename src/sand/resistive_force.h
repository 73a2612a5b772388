#pragma once

#include <Eigen/Core>
#include <memory>

#include "sand/sand_plane.h"
#include "sand/tool_elements.h"
#include "sand/tool_footprint.h"

namespace sandstroke {

/// Sands by name. dry: typical. quikrete: as Agarwal, Goldman and Kamrin (2023) measured it.
enum class SandPreset { dry, quikrete };

/// What sand and a tool's surface are for a force: all of it measurable.
struct SandStrength {
  double friction_angle = 30.0;  ///< deg, internal friction phi
  double density = 1560.0;       ///< kg/m^3, of the bulk
  double tool_friction = 0.4;    ///< mu_s, of the tool's surface
  double yield_way = 0.001;      ///< m, of the tool until the sand's resistance is all there
  SandPreset preset = SandPreset::dry;
};

/// Sets friction_angle and density to those of sand.preset.
void apply_sand_preset(SandStrength& sand);

/// xi = rho g (894 mu^3 - 386 mu^2 + 89 mu) [N/m^3], mu = tan(phi): fitted for mu of 0.3 to 0.9 (Agarwal,
/// Goldman, Kamrin, PNAS 120, 2023).
double resistance(const SandStrength& sand);

/// alpha, of three-dimensional resistive force theory (there, equations 6 to 8 and table 1): the force of the
/// sand on an element over xi x area x depth. normal: outward; motion: unit vectors. The part along the
/// surface is at most tool_friction of the part across it.
Eigen::Vector3d resistive_stress(const Eigen::Vector3d& normal, const Eigen::Vector3d& motion,
                                 double tool_friction);

/// What sand does to a tool.
struct Wrench {
  Eigen::Vector3d force = Eigen::Vector3d::Zero();   ///< N
  Eigen::Vector3d torque = Eigen::Vector3d::Zero();  ///< N m, about the tip
  double stiffness = 0.0;                            ///< N/m, how the force grows with the tool's way
  double stored = 0.0;                               ///< J, at most, that it may give back
  double strength = 0.0;  ///< N, of all its parts, whatever their directions, once the tool has yielded

  /// The sand made weaker, so that its strength is no more than max_force [N] (0: as it is): what a device of
  /// that maximum gives. To cut the force alone would leave sand as stiff as before where the tool turns
  /// round, and turn it round late.
  Wrench limited(double max_force) const;
};

/// What of a tool lies below the sand's plane.
struct VolumeBelow {
  double volume = 0.0;                  ///< m^3
  Eigen::Vector2d moment = {0.0, 0.0};  ///< m^4, the volume times its centroid's way from the tip
  double area = 0.0;                    ///< m^2, by which it grows as the tool sinks
};
/// Below a plane that lies `height` [m] above the tip, and slopes from there: by the divergence theorem.
VolumeBelow volume_below(const ToolElements& elements, double height, const Eigen::Vector2d& slope);

/// Resistive force theory over the surface that touches sand. The law knows a direction of motion and no
/// speed. What stands for it is each element's way through the sand since it met it, in units of the yield
/// way and no longer than 1 (a way beyond that is cut off: a projection): so the force does not depend on
/// speed, holds while the tool rests, and turns round within the yield way when the tool does. In steady
/// motion it is the theory's. Depths count from the plane around the tool; an element touches sand that
/// reaches it beside or below. No memory of disturbed sand, no shadow of one tooth on the next.
class ResistiveForce {
 public:
  /// surface: in its own frame, tip at the origin. element_size [m].
  ResistiveForce(const TriangleMesh& surface, double element_size);

  /// How the tool lies in the bed from now on. The next feel() counts the turn as motion, if the one before
  /// felt something.
  void turn(const Eigen::Matrix3d& rotation);

  /// The tool went by `motion` [m] to where the footprint lies, its tip at `tip` [m].
  Wrench feel(const ToolFootprint& footprint, const Eigen::Vector3d& tip, const SandPlane& plane,
              const Eigen::Vector3d& motion, const SandStrength& sand);
  /// It touches nothing: what was known of its way is gone.
  void lift();

  const ToolElements& elements() const { return elements_; }
  VolumeBelow volume_below(const Eigen::Vector3d& tip, const SandPlane& plane) const {
    return sandstroke::volume_below(elements_, plane.height - tip.z(), plane.slope);
  }

 private:
  ToolElements elements_;
  hwy::AlignedFreeUniquePtr<double[]> ways_;  // 3 columns: x, y, z
  Eigen::Matrix3d rotation_ = Eigen::Matrix3d::Identity(), felt_rotation_ = Eigen::Matrix3d::Identity();
  bool felt_ = false;  // since the last lift()
};

}  // namespace sandstroke
