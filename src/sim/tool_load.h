#pragma once

#include "core/compensated_sum.h"
#include "sand/carried_sand.h"
#include "sand/falling_sand.h"
#include "sand/tool.h"

namespace sandstroke {

/// The sand that a tool carries, as a run's books have it [m^3]: lifted + ran_on + caught = carried +
/// spilled, and spilled = landed + in_air.
struct LoadLedger {
  double lifted = 0.0;   ///< by the tool, out of the bed
  double ran_on = 0.0;   ///< from the bed beside it
  double caught = 0.0;   ///< from sources above it
  double spilled = 0.0;  ///< over the tool's rim
  double in_air = 0.0;   ///< of that, sand that still falls
  double carried = 0.0;  ///< on the tool
  double most = 0.0;     ///< the most that it carried
};

/// What the sand on a tool does to it.
struct LoadOnTool {
  double weight = 0.0;                               ///< N
  double stiffness = 0.0;                            ///< N/m, by which it grows as the tool rises
  Eigen::Vector3d torque = Eigen::Vector3d::Zero();  ///< N m, about the tip, on the bed's axes
};

/// The sand that a tool lifts, carries and spills in the course of a run.
class ToolLoad {
 public:
  /// upper: of the tool where it was placed. density [kg/m^3]: of the sand in bulk.
  ToolLoad(const RelaxationSettings& relaxation, double density, const UpperSide& upper);

  /// The tool was placed: the sand on it goes with it.
  void go_with(const UpperSide& upper) { carried_.lie_on(upper); }
  /// Takes what the tool lifted in its last displacement.
  void take(const Tool& tool);
  /// Takes a height of sand over a cell of the bed, at a place from the tip on the bed's axes [m].
  void take(const UpperSide& upper, const LiftedSand& caught);
  /// Brings the sand on the tool to rest with its tip here [m], at this time [s]. What spills lands once it
  /// has fallen.
  void relax(const Tool& tool, HeightField& bed, const Eigen::Vector3d& tip, double time);
  /// Lands what comes down before this time [s].
  void land(HeightField& bed, double until);
  /// Whether sand has landed since the last relax().
  bool has_landed() const { return has_landed_; }
  /// Whether the last relax() moved sand onto the tool or from it.
  bool has_moved() const { return has_moved_; }

  /// A tick of so many seconds passes. What a relaxation moved at once takes `settling` seconds to run in
  /// truth, and so the hand feels it come and go.
  void pass(double tick);
  static constexpr double settling = 0.02;  ///< s
  /// What the tool feels of it. level [m above the tip]: of the sand around; what lies below that presses on
  /// the tool as all sand does, which the law of force knows. -infinity: the tool touches no sand.
  LoadOnTool on_tool(const UpperSide& upper, double level) const;
  /// kg, on the tool.
  double mass() const { return density_ * carried_.volume(); }
  /// Sand that the bed has got, less what was taken from it [m^3].
  double given_volume() const;
  const CarriedSand& carried() const { return carried_; }
  LoadLedger ledger() const;
  void visit_state(StateVisitor& state);
  /// After a state was put back.
  void go_on(const UpperSide& upper) { carried_.go_on(upper); }

 private:
  /// What spilled over one cell of the bed.
  struct Packet {
    double volume;  // m^3
    int row, col;

    template <class State>
    void visit_state(State& state) {
      state.value("volume", volume);
      state.value("row", row);
      state.value("col", col);
    }
  };
  double volume_in_air() const;

  CarriedSand carried_;
  FallingSand<Packet> falling_;
  double density_;
  CompensatedSum lifted_, ran_on_, caught_, spilled_;  // m^3
  double most_ = 0.0;                                  // m^3
  double felt_volume_ = 0.0;                           // m^3, and its moment as CarriedSand::moment() [m^4]
  Eigen::Vector3d felt_moment_ = Eigen::Vector3d::Zero();
  bool has_moved_ = false, has_landed_ = false;
};

}  // namespace sandstroke
