#pragma once

#include "fit/felt_law.h"
#include "rules/force.h"

namespace sandstroke {

/// A tick in which the tool touched sand and a force was recorded.
struct FeltTick {
  double depth = 0.0;        ///< m, of the tip below the sand's level, > 0
  Eigen::Vector3d velocity;  ///< m/s, of the tool in the bed
  Eigen::Vector3d recorded;  ///< N, on the hand
};

inline constexpr ForceConstant paper_constants[] = {
    {"k_s", "N", "force.k_s"}, {"k_c", "1/m", "force.k_c"}, {"k_f", "s/m", "force.k_f"}};

/// The force of sand_force(). A fit changes k_s k_c instead of k_s: where k_c d is small, the force is nearly
/// k_s k_c d and says little about k_s alone.
class PaperLaw : public FeltLaw {
 public:
  /// max_force [N]; 0: no limit. period [s] of a tick.
  PaperLaw(const std::vector<FeltTick>& ticks, const ForceSettings& start, double max_force, double period);

  ForceSettings settings(const Eigen::VectorXd& values) const;

  std::span<const ForceConstant> constants() const override { return paper_constants; }
  ForceScale scale() const override {
    return {"k_s k_c", "stiffness", "N/m", "growth of the force with depth, at small depths"};
  }
  const Eigen::VectorXd& start() const override { return start_; }
  Eigen::VectorXd weak() const override;
  Eigen::VectorXd numbers(const Eigen::VectorXd& values) const override;
  Eigen::VectorXd values(const Eigen::VectorXd& numbers) const override;
  /// k_s and k_c change together, so that k_s k_c stays.
  Eigen::VectorXd with(Eigen::VectorXd values, std::size_t constant, double value) const override;
  Range range(std::size_t constant) const override;
  Eigen::Matrix3Xd recorded() const override;
  Eigen::Matrix3Xd forces(const Eigen::VectorXd& values, DeviceLimit limit) const override;
  double max_force() const override { return max_force_; }
  std::int64_t ticks() const override { return all_ticks_; }
  double period() const override { return period_; }

 private:
  std::vector<FeltTick> ticks_;
  ForceSettings settings_;
  Eigen::VectorXd start_;
  double max_force_, period_;
  std::int64_t all_ticks_;
};

}  // namespace sandstroke
