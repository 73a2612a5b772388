#include "fit/sand_grid.h"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "core/bisection.h"
#include "core/elementary.h"

namespace sandstroke {
namespace {

using Eigen::VectorXd;

constexpr double nearest = 0.02;  // distance of the nearest node from the middle, as a fraction of the middle

/// A constant of a sand, and its limits.
struct SandConstant {
  std::string_view name;
  double SandStrength::*member;
  double least, most;                ///< stand for 0 and for more than any sand has
  double least_middle, most_middle;  ///< limits of a grid's middle
};

constexpr SandConstant sand_constants[] = {
    {"friction_angle", &SandStrength::friction_angle, 0.0, 90.0, 0.0, 90.0},
    {"tool_friction", &SandStrength::tool_friction, 0.0, 1e3, 0.02, 3.0},
    {"yield", &SandStrength::yield_way, 1e-6, 1.0, 1e-5, 0.1}};

constexpr const SandConstant* entry_of(const ForceConstant& constant) {
  return std::find_if(std::begin(sand_constants), std::end(sand_constants),
                      [&](const SandConstant& one) { return one.name == constant.name; });
}
static_assert(std::all_of(std::begin(rft_constants), std::end(rft_constants), [](const ForceConstant& one) {
  return entry_of(one) != std::end(sand_constants);
}));

const SandConstant& in_sand(const ForceConstant& constant) { return *entry_of(constant); }

}  // namespace

VectorXd values_in(const SandStrength& sand, std::span<const ForceConstant> constants) {
  VectorXd values(constants.size());
  std::transform(constants.begin(), constants.end(), values.begin(),
                 [&](const ForceConstant& one) { return sand.*in_sand(one).member; });
  return values;
}

double friction_angle_of(double resistance, double density) {
  constexpr int to_the_last_bit = 64;
  return boundary_between(0.0, 90.0, to_the_last_bit, mean, [&](double angle) {
    return sandstroke::resistance({.friction_angle = angle, .density = density}) < resistance;
  });
}

SandGrid::SandGrid(std::span<const ForceConstant> constants, const SandStrength& scene, const VectorXd& about,
                   const std::vector<bool>& is_free)
    : constants_(constants), start_(values_in(scene, constants)), sands_(2, scene) {
  for (std::size_t i = 1; i < constants.size(); ++i) {
    const SandConstant& one = in_sand(constants[i]);
    if (is_free[i])
      sands_[1].*one.member =
          std::clamp(about[static_cast<Eigen::Index>(i)], one.least_middle, one.most_middle);
  }
  for (std::size_t i = 1; i < constants.size(); ++i)
    if (is_free[i]) add_nodes(i);
}

void SandGrid::add_nodes(std::size_t constant) {
  constexpr int on_each_side = 9;
  const SandConstant& one = in_sand(constants_[constant]);
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

FeltLaw::Range SandGrid::range(std::size_t constant) const {
  const SandConstant& one = in_sand(constants_[constant]);
  return {one.least, one.most};
}

bool SandGrid::is_close_about(const VectorXd& values) const {
  const VectorXd middle = values_in(sands_[1], constants_);
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
    const double fraction = (value - *(above - 1)) / (*above - *(above - 1));
    const auto node = static_cast<Eigen::Index>(axis.first) + (above - axis.values.begin());
    weights[node - 1] += 1.0 - fraction;
    weights[node] += fraction;
    weights[1] -= 1.0;
  }
  return weights;
}

}  // namespace sandstroke
