#pragma once

#include "fit/felt_law.h"
#include "haptics/force_model.h"
#include "sand/resistive_force.h"

namespace sandstroke {

/// Of resistive force theory. The density is not among them: the force goes with density and friction angle
/// by one number, the resistance.
inline constexpr ForceConstant rft_constants[] = {{"friction_angle", "deg", "force.friction_angle"},
                                                  {"tool_friction", "", "force.tool_friction"},
                                                  {"yield", "m", "force.yield", false}};
inline constexpr ForceConstant archimedes_constants[] = {rft_constants[0], rft_constants[2]};
/// Of a law but the paper's.
std::span<const ForceConstant> contact_constants(ForceLaw law);

/// Those values of a sand.
Eigen::VectorXd contact_values(ForceLaw law, const SandStrength& sand);

/// The angle [deg] of sand with that resistance [N/m^3] and density [kg/m^3]: the inverse of resistance(),
/// which grows with the angle all the way from 0 to 90 deg. It may be one that no scene can have.
double friction_angle_of(double resistance, double density);

/// Sands in which every tick is felt, so that the force is known in between: that of the scene, a middle one,
/// and for each constant but the angle some that differ from the middle in that alone. Constants are counted
/// as in contact_constants().
class SandGrid {
 public:
  /// about: values; the middle is there in what is free, within what sand and tools are like, and as the
  /// scene in all else. The nodes of a free constant are the scene's value and the middle's, nine on each
  /// side of it, the nearest 2 % away and each twice as far as the one before, and what stands for 0 and for
  /// more than any (tool_friction 0 and 1000, yield 1e-6 and 1 m).
  SandGrid(ForceLaw law, const SandStrength& scene, const Eigen::VectorXd& about,
           const std::vector<bool>& is_free);

  ForceLaw law() const { return law_; }
  /// What stands for 0 and for more than any; of the angle none.
  std::vector<double> extremes(std::size_t constant) const;
  /// Values whose force the grid knows to about 1e-4 of it: less than half the way to the nearest nodes.
  bool is_close_about(const Eigen::VectorXd& values) const;
  const std::vector<SandStrength>& sands() const { return sands_; }
  /// Of the scene's sand.
  const Eigen::VectorXd& start() const { return start_; }
  /// How much of each sand's force, at the same resistance, is in that of a sand with these values: linear
  /// between nodes, and beyond the last two.
  Eigen::VectorXd weights(const Eigen::VectorXd& values) const;

 private:
  struct Axis {
    Eigen::Index constant;
    std::size_t first;           // of sands_
    std::vector<double> values;  // of its nodes, ever larger
  };

  void add_nodes(std::size_t constant);

  ForceLaw law_;
  Eigen::VectorXd start_;
  std::vector<SandStrength> sands_;
  std::vector<Axis> axes_;
};

}  // namespace sandstroke
