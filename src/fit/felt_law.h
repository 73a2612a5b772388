#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

namespace sandstroke {

/// A constant of a law of force.
struct ForceConstant {
  const char *name, *unit, *key;  ///< key: in a scene
  bool by_default = true;         ///< fitted unless others are asked for
};

/// What the force is in proportion to: a quantity of more than one constant.
struct ForceScale {
  const char *name, *json_name, *unit, *meaning;
};

/// A law of force over the ticks of a run in which its tool touched sand and a force was recorded: what a fit
/// needs to know of it. "values" are those of constants(), in their order and unit; none is negative, and
/// where one is 0, what it stands for does not act.
class FeltLaw {
 public:
  virtual ~FeltLaw() = default;

  virtual std::span<const ForceConstant> constants() const = 0;
  virtual ForceScale scale() const = 0;

  /// Of the scene.
  virtual const Eigen::VectorXd& start() const = 0;
  /// Values of sand so weak that the device's limit cuts little of its force.
  virtual Eigen::VectorXd weak() const = 0;

  /// Numbers that a fit changes instead of the values, as many, not negative: the force is about linear in
  /// them, and the first is the scale.
  virtual Eigen::VectorXd numbers(const Eigen::VectorXd& values) const = 0;
  virtual Eigen::VectorXd values(const Eigen::VectorXd& numbers) const = 0;

  /// Values with another such constant, from which a recording that determines it can tell these. Empty: the
  /// constant is fitted, whatever the recording tells of it.
  virtual std::vector<Eigen::VectorXd> rivals(const Eigen::VectorXd& /*values*/,
                                              std::size_t /*constant*/) const {
    return {};
  }
  /// The least and the most that the constant can be: with a constant that is determined, both leave clearly
  /// more. Empty: as above.
  virtual std::vector<double> extremes(std::size_t /*constant*/) const { return {}; }

  /// N, on the hand, a column for each tick.
  virtual Eigen::Matrix3Xd recorded() const = 0;
  /// N, a column for each tick; within the device's limit, or as if it had none.
  virtual Eigen::Matrix3Xd forces(const Eigen::VectorXd& values, bool limited) const = 0;
  /// N; 0: none.
  virtual double max_force() const = 0;
  /// Of the run; those above may be some of them, evenly chosen.
  virtual std::int64_t ticks() const = 0;
};

/// More of them say little more.
inline constexpr std::size_t most_fitted_ticks = 50'000;

}  // namespace sandstroke
