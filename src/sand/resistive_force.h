#pragma once

#include <Eigen/Core>
#include <memory>

#include "core/aligned_vector.h"
#include "sand/sand_before.h"

namespace sandstroke {

class StrengthByPlace;

/// Sands by name. dry: typical. quikrete: as Agarwal, Goldman and Kamrin (2023) measured it.
enum class SandPreset { dry, quikrete };

/// The properties of sand and of a tool's surface that the force depends on. All can be measured.
struct SandStrength {
  double friction_angle = 30.0;  ///< deg, internal friction phi
  double density = 1560.0;       ///< kg/m^3, of the bulk
  double tool_friction = 0.4;    ///< mu_s, of the tool's surface
  double yield_way = 0.001;      ///< m that the tool moves until the sand resists fully
  double blend = 0.0;  ///< m around a border to other sand in which strength changes; 0: the tool's width
  SandPreset preset = SandPreset::dry;
};

/// Sets friction_angle and density to those of sand.preset.
void apply_sand_preset(SandStrength& sand);

/// xi = rho g (894 mu^3 - 386 mu^2 + 89 mu) [N/m^3], mu = tan(phi): fitted for mu of 0.3 to 0.9 (Agarwal,
/// Goldman, Kamrin, PNAS 120, 2023).
double resistance(const SandStrength& sand);

/// alpha of three-dimensional resistive force theory (there, equations 6 to 8 and table 1): the force of the
/// sand on an element, divided by xi x area x depth. normal points outward; normal and motion are unit
/// vectors. The part along the surface is at most tool_friction times the part across it.
Eigen::Vector3d resistive_stress(const Eigen::Vector3d& normal, const Eigen::Vector3d& motion,
                                 double tool_friction);

/// tan(45 deg + talus / 2): the reach of the wedge that slides before an upright face, over its depth
/// (Rankine). The talus angle [deg] counts, not the friction angle, so that a tool's force stays proportional
/// to resistance(), whatever the friction angle.
double wedge_reach(double talus_angle);

/// The force of sand on a tool, with its torque, stiffness and energy.
struct Wrench {
  Eigen::Vector3d force = Eigen::Vector3d::Zero();   ///< N
  Eigen::Vector3d torque = Eigen::Vector3d::Zero();  ///< N m, about the tip
  double stiffness = 0.0;                            ///< N/m, growth of the force with the tool's way
  double stored = 0.0;                               ///< J that the sand may give back, at most
  double strength = 0.0;  ///< N, sum of the sizes of all elements' forces once the tool has yielded
  double whole = 0.0;     ///< N, size of the force on the whole tool once it has yielded
  Eigen::Vector3d given = Eigen::Vector3d::Zero();  ///< N, what the scene's device gives of the force
  double given_stored = 0.0;                        ///< J, as stored, of that

  template <class State>
  void visit_state(State& state) {
    state.value("force", force);
    state.value("torque", torque);
    state.value("stiffness", stiffness);
    state.value("stored", stored);
    state.value("strength", strength);
    state.value("whole", whole);
    state.value("given", given);
    state.value("given_stored", given_stored);
  }

  /// The wrench of weaker sand, whose force on the whole tool is at most max_force [N], as a device of that
  /// maximum is to give it (0: unchanged). If only the force were cut, the sand would stay as stiff as before
  /// when the tool reverses, and reverse the force late. Stiffness and strength are those of sand in which
  /// the elements' forces add up to no more than max_force, so a tool whose elements push against each other
  /// is not stiffer than the device can bear.
  Wrench limited(double max_force) const;
};

/// The part of a tool below the sand's plane.
struct VolumeBelow {
  double volume = 0.0;                  ///< m^3
  Eigen::Vector2d moment = {0.0, 0.0};  ///< m^4, the volume times its centroid's offset from the tip
  double area = 0.0;                    ///< m^2, growth of the volume per depth that the tool sinks
};
/// For a plane that lies `height` [m] above the tip, and has this slope. Computed by the divergence theorem.
/// places: where it is not null, every column counts as the sand's pressure below it, as a depth in the
/// scene's own sand; it has looked at the elements, with the tip at tip_height [m].
VolumeBelow volume_below(const ToolElements& elements, double height, const Eigen::Vector2d& slope,
                         const StrengthByPlace* places = nullptr, double tip_height = 0.0);

/// Resistive force theory over the surface that touches sand. The theory uses a direction of motion and no
/// speed. The direction here is each element's displacement through the sand since it met the sand, in units
/// of yield_way, and cut to length 1 (a projection). So the force does not depend on speed, stays while the
/// tool rests, and reverses within yield_way when the tool does. In steady motion it is the theory's.
///
/// An element's depth counts from the sand before its side (SandBefore); if it looks down or up, from the
/// sand around the tool with its slope, and more from the sand ahead. All elements below that height are in
/// the sand. So sand covers a tool that goes deep: faces that look up feel the sand that a height field cuts
/// away above them. The force ignores that sand was loosened before, and that one tooth shields the next.
class ResistiveForce {
 public:
  /// surface: in its own frame, tip at the origin. element_size [m]. talus_angle [deg]: of the sand.
  ResistiveForce(const TriangleMesh& surface, double element_size, double talus_angle = 30.0);

  /// Sets the tool's orientation in the bed. The next feel() counts the turn as motion, unless the tool was
  /// lifted.
  void turn(const Eigen::Matrix3d& rotation) {
    elements_.turn(rotation);
    before_.turn(rotation);
  }

  /// Returns the wrench after the tool has moved by `motion` [m] to where it displaced last, with its tip at
  /// `tip` [m]. The footprint's heights are the bed's. places: where that sand is of other kinds; null:
  /// nowhere.
  Wrench feel(const HeightField& bed, const ToolFootprint& footprint, const Eigen::Vector3d& tip,
              const Eigen::Vector3d& motion, const SandStrength& sand, StrengthByPlace* places = nullptr);
  /// Tells that the tool touches nothing: forgets the elements' displacements.
  void lift();

  /// The tool must be turned as it was.
  void visit_state(StateVisitor& state) {
    before_.visit_state(state);
    state.row("force.ways", ways_);
    state.value("force.felt_rotation", felt_rotation_);
    state.value("force.felt", felt_);
  }

  const ToolElements& elements() const { return elements_; }

 private:
  ToolElements elements_;
  SandBefore before_;
  double wedge_;
  AlignedVector<double> ways_;  // 3 columns: x, y, z
  Eigen::Matrix3d felt_rotation_ = Eigen::Matrix3d::Identity();
  bool felt_ = false;  // since the last lift()
};

}  // namespace sandstroke
