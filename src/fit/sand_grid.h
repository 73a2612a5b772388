#pragma once

#include "fit/felt_law.h"
#include "sand/resistive_force.h"

namespace sandstroke {

/// The constants of resistive force theory. The density is not among them: density and friction angle change
/// the force only through one number, the resistance.
inline constexpr ForceConstant rft_constants[] = {{"friction_angle", "deg", "force.friction_angle"},
                                                  {"tool_friction", "", "force.tool_friction"},
                                                  {"yield", "m", "force.yield", false}};
inline constexpr ForceConstant archimedes_constants[] = {rft_constants[0], rft_constants[2]};

/// The values of these constants in a sand.
Eigen::VectorXd values_in(const SandStrength& sand, std::span<const ForceConstant> constants);

/// The friction angle [deg] of sand with that resistance [N/m^3] and density [kg/m^3]: the inverse of
/// resistance(), which grows with the angle all the way from 0 to 90 deg. It may be an angle that no scene
/// can have.
double friction_angle_of(double resistance, double density);

/// The sands in which every tick is felt, so that the force between them is known. They are the scene's, a
/// middle one, and for each constant but the angle some that differ from the middle in that constant alone.
class SandGrid {
 public:
  /// constants: of the law, the angle first. about: their values. The middle sand has these where a constant
  /// is free, within what sand and tools are like; in all else it is the scene's. The nodes of a free
  /// constant are the scene's value and the middle's, nine on each side of the middle, the nearest 2 % away
  /// and each twice as far as the one before, and the values that stand for 0 and for more than any
  /// (tool_friction 0 and 1000, yield 1e-6 and 1 m).
  SandGrid(std::span<const ForceConstant> constants, const SandStrength& scene, const Eigen::VectorXd& about,
           const std::vector<bool>& is_free);

  std::span<const ForceConstant> constants() const { return constants_; }
  FeltLaw::Range range(std::size_t constant) const;
  /// True if the grid knows the force of these values to about 1e-4 of it: they lie less than half the way to
  /// the nearest nodes.
  bool is_close_about(const Eigen::VectorXd& values) const;
  const std::vector<SandStrength>& sands() const { return sands_; }
  /// The values of the scene's sand.
  const Eigen::VectorXd& start() const { return start_; }
  /// Factors of the sands' forces. Their sum is the force of a sand with these values, at the same
  /// resistance. It is linear between nodes, and beyond the last two.
  Eigen::VectorXd weights(const Eigen::VectorXd& values) const;

 private:
  struct Axis {
    Eigen::Index constant;
    std::size_t first;           // its index in sands_
    std::vector<double> values;  // its nodes', increasing
  };

  void add_nodes(std::size_t constant);

  std::span<const ForceConstant> constants_;
  Eigen::VectorXd start_;
  std::vector<SandStrength> sands_;
  std::vector<Axis> axes_;
};

}  // namespace sandstroke
