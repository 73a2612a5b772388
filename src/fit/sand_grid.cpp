#include "fit/sand_grid.h"

#include <algorithm>
#include <cmath>

#include "core/bisection.h"
#include "core/elementary.h"

namespace sandstroke {
namespace {

using Eigen::VectorXd;

constexpr double nearest = 0.02;  // distance of the nearest node from the middle, as a fraction of the middle

/// A constant of a sand, and its limits.
struct SandConstant {
  double SandStrength::*member;
  double least, most;                ///< stand for 0 and for more than any sand has
  double least_middle, most_middle;  ///< limits of a grid's middle
};

/// The constants of a law, in the order of contact_constants().
std::vector<SandConstant> sand_constants(ForceLaw law) {
  const SandConstant angle = {&SandStrength::friction_angle, 0.0, 90.0, 0.0, 90.0},
                     friction = {&SandStrength::tool_friction, 0.0, 1e3, 0.02, 3.0},
                     yield = {&SandStrength::yield_way, 1e-6, 1.0, 1e-5, 0.1};
  if (law == ForceLaw::archimedes) return {angle, yield};
  return {angle, friction, yield};
}

}  // namespace

std::span<const ForceConstant> contact_constants(ForceLaw law) {
  if (law == ForceLaw::archimedes) return archimedes_constants;
  return rft_constants;
}

VectorXd contact_values(ForceLaw law, const SandStrength& sand) {
  const auto constants = sand_constants(law);
  VectorXd values(constants.size());
  std::transform(constants.begin(), constants.end(), values.begin(),
                 [&](const SandConstant& one) { return sand.*one.member; });
  return values;
}

double friction_angle_of(double resistance, double density) {
  constexpr int to_the_last_bit = 64;
  return boundary_between(0.0, 90.0, to_the_last_bit, mean, [&](double angle) {
    return sandstroke::resistance({.friction_angle = angle, .density = density}) < resistance;
  });
}

SandGrid::SandGrid(ForceLaw law, const SandStrength& scene, const VectorXd& about,
                   const std::vector<bool>& is_free)
    : law_(law), start_(contact_values(law, scene)), sands_(2, scene) {
  const auto constants = sand_constants(law);
  for (std::size_t i = 1; i < constants.size(); ++i)
    if (is_free[i])
      sands_[1].*constants[i].member = std::clamp(about[static_cast<Eigen::Index>(i)],
                                                  constants[i].least_middle, constants[i].most_middle);
  for (std::size_t i = 1; i < constants.size(); ++i)
    if (is_free[i]) add_nodes(i);
}

void SandGrid::add_nodes(std::size_t constant) {
  constexpr int on_each_side = 9;
  const SandConstant one = sand_constants(law_)[constant];
  const double middle = sands_[1].*one.member;
  Axis axis{static_cast<Eigen::Index>(constant), sands_.size(), {}};
  std::vector<double> values = {one.least, one.most, sands_[0].*one.member, middle};
  for (int k = 0; k < on_each_side; ++k)
    for (const double sign : {-1.0, 1.0})
      values.push_back(middle * elementary::exp(std::ldexp(sign * nearest, k)));
  std::sort(values.begin(), values.end());
  for (const double value : values) {
    constexpr double apart = 1e-6;  // as a fraction: between closer nodes there is no slope to speak of
    if (!axis.values.empty() && value <= (1.0 + apart) * axis.values.back()) continue;
    axis.values.push_back(value);
    sands_.push_back(SandStrength(sands_[1]));
    sands_.back().*one.member = value;
  }
  axes_.push_back(std::move(axis));
}

std::vector<double> SandGrid::extremes(std::size_t constant) const {
  if (constant == 0) return {};
  const SandConstant one = sand_constants(law_)[constant];
  return {one.least, one.most};
}

bool SandGrid::is_close_about(const VectorXd& values) const {
  const VectorXd middle = contact_values(law_, sands_[1]);
  return std::all_of(axes_.begin(), axes_.end(), [&](const Axis& axis) {
    return std::abs(values[axis.constant] - middle[axis.constant]) <= 0.5 * nearest * middle[axis.constant];
  });
}

VectorXd SandGrid::weights(const VectorXd& values) const {
  VectorXd weights = VectorXd::Zero(static_cast<Eigen::Index>(sands_.size()));
  const Eigen::Index others = values.size() - 1;
  if (values.tail(others) == start_.tail(others)) {
    weights[0] = 1.0;
    return weights;
  }
  weights[1] = 1.0;
  for (const Axis& axis : axes_) {
    const double value = values[axis.constant];
    const auto above = std::clamp(std::upper_bound(axis.values.begin(), axis.values.end(), value),
                                  axis.values.begin() + 1, axis.values.end() - 1);
    const double share = (value - *(above - 1)) / (*above - *(above - 1));
    const auto node = static_cast<Eigen::Index>(axis.first) + (above - axis.values.begin());
    weights[node - 1] += 1.0 - share;
    weights[node] += share;
    weights[1] -= 1.0;
  }
  return weights;
}

}  // namespace sandstroke
