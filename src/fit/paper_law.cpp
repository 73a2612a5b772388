#include "fit/paper_law.h"

#include <algorithm>

namespace sandstroke {
namespace {

using Eigen::VectorXd;

constexpr double least_k_c = 1e-6;  // 1/m: stands for 0

enum PaperConstant : Eigen::Index { k_s, k_c, k_f };

std::vector<FeltTick> evenly_chosen(const std::vector<FeltTick>& ticks) {
  if (ticks.size() <= most_fitted_ticks) return ticks;
  std::vector<FeltTick> chosen;
  for (std::size_t i = 0; i < most_fitted_ticks; ++i)
    chosen.push_back(ticks[i * ticks.size() / most_fitted_ticks]);
  return chosen;
}

}  // namespace

PaperLaw::PaperLaw(const std::vector<FeltTick>& ticks, const ForceSettings& start, double max_force,
                   double period)
    : ticks_(evenly_chosen(ticks)),
      settings_(start),
      start_(Eigen::Vector3d(start.k_s, start.k_c, start.k_f)),
      max_force_(max_force),
      period_(period),
      all_ticks_(static_cast<std::int64_t>(ticks.size())) {}

ForceSettings PaperLaw::settings(const VectorXd& values) const {
  ForceSettings settings = settings_;
  settings.k_s = values[k_s];
  settings.k_c = values[k_c];
  settings.k_f = values[k_f];
  return settings;
}

VectorXd PaperLaw::weak() const {
  constexpr double weak_k_s = 1e-3, weak_k_f = 1e-2;  // N, s/m: a drag below any limit
  return Eigen::Vector3d(std::min(start_[k_s], weak_k_s), start_[k_c], std::min(start_[k_f], weak_k_f));
}

VectorXd PaperLaw::numbers(const VectorXd& values) const {
  return Eigen::Vector3d(values[k_s] * values[k_c], values[k_c], values[k_f]);
}

VectorXd PaperLaw::values(const VectorXd& numbers) const {
  const double growth = std::max(numbers[k_c], least_k_c);
  return Eigen::Vector3d(numbers[0] / growth, growth, numbers[k_f]);
}

VectorXd PaperLaw::with(VectorXd values, std::size_t constant, double value) const {
  const double stiffness = values[k_s] * values[k_c];
  values[static_cast<Eigen::Index>(constant)] = value;
  if (constant == k_s) values[k_c] = stiffness / value;
  if (constant == k_c) values[k_s] = stiffness / value;
  return values;
}

FeltLaw::Range PaperLaw::range(std::size_t constant) const {
  return constant == k_c ? Range{.least = least_k_c} : Range{};
}

Eigen::Matrix3Xd PaperLaw::recorded() const {
  Eigen::Matrix3Xd recorded(3, ticks_.size());
  Eigen::Index i = 0;
  for (const FeltTick& tick : ticks_) recorded.col(i++) = tick.recorded;
  return recorded;
}

Eigen::Matrix3Xd PaperLaw::forces(const VectorXd& values, DeviceLimit limit) const {
  const ForceSettings force = settings(values);
  const double max_force = limit == DeviceLimit::applied ? max_force_ : 0.0;
  Eigen::Matrix3Xd forces(3, ticks_.size());
  Eigen::Index i = 0;
  for (const FeltTick& tick : ticks_)
    forces.col(i++) = sand_force(tick.depth, tick.velocity, max_force, force).total;
  return forces;
}

}  // namespace sandstroke
