#include "fit/contact_law.h"

#include <algorithm>

namespace sandstroke {

using Eigen::VectorXd;

void ContactLaw::add(const std::vector<Wrench>& felt, const Eigen::Vector3d& recorded) {
  if (ticks_++ % every_ != 0) return;
  for (std::size_t i = 0; i < felt.size(); ++i) {
    const double all = resistance(grid_.sands()[i]);
    const Eigen::Vector3d& given = felt[i].given;
    felt_.emplace_back(given.x() / all, given.y() / all, given.z() / all, felt[i].strength / all);
  }
  recorded_.push_back(recorded);
  if (recorded_.size() <= most_fitted_ticks) return;
  const auto sands = static_cast<std::ptrdiff_t>(felt.size());
  std::size_t kept = 0;
  for (std::size_t i = 0; i < recorded_.size(); i += 2) {
    recorded_[kept] = recorded_[i];
    std::copy_n(felt_.begin() + static_cast<std::ptrdiff_t>(i) * sands, sands,
                felt_.begin() + static_cast<std::ptrdiff_t>(kept) * sands);
    ++kept;
  }
  recorded_.resize(kept);
  felt_.resize(kept * felt.size());
  every_ *= 2;
}

VectorXd ContactLaw::weak() const {
  constexpr double weak_angle = 5.0;  // deg: a seventeenth of the resistance at 30 deg
  VectorXd weak = start();
  weak[0] = std::min(weak[0], weak_angle);
  return weak;
}

VectorXd ContactLaw::numbers(const VectorXd& values) const {
  VectorXd numbers = values;
  numbers[0] = resistance({.friction_angle = values[0], .density = grid_.sands()[0].density});
  return numbers;
}

VectorXd ContactLaw::values(const VectorXd& numbers) const {
  VectorXd values = numbers;
  values[0] = friction_angle_of(numbers[0], grid_.sands()[0].density);
  return values;
}

Eigen::Matrix3Xd ContactLaw::recorded() const {
  return Eigen::Matrix3Xd::Map(recorded_.data()->data(), 3, static_cast<Eigen::Index>(recorded_.size()));
}

Eigen::Matrix3Xd ContactLaw::forces(const VectorXd& values, DeviceLimit limit) const {
  const VectorXd weights = numbers(values)[0] * grid_.weights(values);
  const Eigen::Index sands = weights.size();
  Eigen::Matrix3Xd forces(3, static_cast<Eigen::Index>(recorded_.size()));
  for (Eigen::Index tick = 0; tick < forces.cols(); ++tick) {
    Eigen::Vector4d felt = Eigen::Vector4d::Zero();
    for (Eigen::Index i = 0; i < sands; ++i)
      if (weights[i] != 0.0) felt += weights[i] * felt_[static_cast<std::size_t>(tick * sands + i)];
    const Wrench wrench{.force = felt.head<3>(), .strength = felt[3]};
    forces.col(tick) = (limit == DeviceLimit::applied ? wrench.limited(max_force_) : wrench).force;
  }
  return forces;
}

}  // namespace sandstroke
