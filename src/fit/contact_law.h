#pragma once

#include "fit/sand_grid.h"

namespace sandstroke {

/// The force of a contact. It is proportional to the sand's resistance. In the other constants it is
/// interpolated between the grid's sands.
class ContactLaw : public FeltLaw {
 public:
  /// max_force [N]; 0: no limit. period [s] of a tick.
  ContactLaw(SandGrid grid, double max_force, double period)
      : grid_(std::move(grid)), max_force_(max_force), period_(period) {}

  const SandGrid& grid() const { return grid_; }
  /// Adds the next tick: a force for each of the grid's sands. To limit memory, it drops every second tick if
  /// there are too many, and every second of those to come, too.
  void add(const std::vector<Wrench>& felt, const Eigen::Vector3d& recorded);
  std::span<const ForceConstant> constants() const override { return grid_.constants(); }
  ForceScale scale() const override {
    return {"resistance", "resistance", "N/m^3", "the sand's force is proportional to it"};
  }
  const Eigen::VectorXd& start() const override { return grid_.start(); }
  Eigen::VectorXd weak() const override;
  Eigen::VectorXd numbers(const Eigen::VectorXd& values) const override;
  Eigen::VectorXd values(const Eigen::VectorXd& numbers) const override;
  Range range(std::size_t constant) const override { return grid_.range(constant); }
  Eigen::Matrix3Xd recorded() const override;
  /// A limit cuts the sand's own force. A device goes there by an elastic way of its own (contact_force.cpp),
  /// which is left out: it changes the friction angle by some 0.01 deg where the limit acts all the time.
  Eigen::Matrix3Xd forces(const Eigen::VectorXd& values, DeviceLimit limit) const override;
  double max_force() const override { return max_force_; }
  std::int64_t ticks() const override { return ticks_; }
  double period() const override { return period_; }

 private:
  SandGrid grid_;
  double max_force_, period_;
  std::vector<Eigen::Vector4d> felt_;  // each tick's, for each sand: force and strength over resistance [m^3]
  std::vector<Eigen::Vector3d> recorded_;
  std::int64_t ticks_ = 0, every_ = 1;
};

}  // namespace sandstroke
