#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace sandstroke {

/// A constant of a force law.
struct ForceConstant {
  const char *name, *unit, *key;  ///< key: its key in a scene
  bool by_default = true;         ///< fitted unless others are asked for
};

/// The quantity, made of more than one constant, that the force is proportional to.
struct ForceScale {
  const char *name, *json_name, *unit, *meaning;
};

/// Whether a force is cut at the device's limit, or is as if the device had none.
enum class DeviceLimit { applied, ignored };

/// A force law over the ticks of a run in which the tool touched sand and a force was recorded: what a fit
/// must know of it. "values" are the values of constants(), in their order and unit. None is negative. A
/// value of 0 switches off what the constant stands for.
class FeltLaw {
 public:
  virtual ~FeltLaw() = default;

  virtual std::span<const ForceConstant> constants() const = 0;
  virtual ForceScale scale() const = 0;

  /// The scene's values.
  virtual const Eigen::VectorXd& start() const = 0;
  /// Values of sand so weak that the device's limit cuts little of its force.
  virtual Eigen::VectorXd weak() const = 0;

  /// Numbers that a fit changes instead of the values, as many as these and not negative. The force is about
  /// linear in them, and the first is the scale.
  virtual Eigen::VectorXd numbers(const Eigen::VectorXd& values) const = 0;
  virtual Eigen::VectorXd values(const Eigen::VectorXd& numbers) const = 0;

  /// `values` with another value of this constant. The scale stays where the law lets it.
  virtual Eigen::VectorXd with(Eigen::VectorXd values, std::size_t constant, double value) const {
    values[static_cast<Eigen::Index>(constant)] = value;
    return values;
  }
  /// A constant's least value, which stands for 0, and its greatest, which stands for more than any.
  struct Range {
    double least = 0.0, most = std::numeric_limits<double>::infinity();
  };
  virtual Range range(std::size_t /*constant*/) const { return {}; }

  /// The recorded force on the hand [N], a column for each tick.
  virtual Eigen::Matrix3Xd recorded() const = 0;
  /// The law's force [N], a column for each tick.
  virtual Eigen::Matrix3Xd forces(const Eigen::VectorXd& values, DeviceLimit limit) const = 0;
  /// The device's limit [N]; 0: none.
  virtual double max_force() const = 0;
  /// The number of the run's ticks. The columns above may be some of them, evenly chosen.
  virtual std::int64_t ticks() const = 0;
  /// The time from a tick to the next [s].
  virtual double period() const = 0;
};

/// A fit takes at most so many ticks: more of them say little more.
inline constexpr std::size_t most_fitted_ticks = 50'000;

}  // namespace sandstroke
