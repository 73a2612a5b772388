#include "fit/force_fit.h"

#include <spdlog/fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.h"
#include "core/interrupt.h"

namespace sandstroke {
namespace {

using Eigen::VectorXd;

constexpr Eigen::Index least_ticks = 100;

/// The root mean square [N] of the difference of two forces, without the device's limit.
double difference_rms(const FeltLaw& law, const VectorXd& one, const VectorXd& other) {
  return rms(law.forces(one, DeviceLimit::ignored) - law.forces(other, DeviceLimit::ignored));
}

double half(const Interval& interval) { return 0.5 * (interval.high - interval.low); }

VectorXd without(VectorXd values, Eigen::Index constant) {
  values[constant] = 0.0;
  return values;
}

void check_enough(const FeltLaw& law) {
  if (law.ticks() < least_ticks)
    throw_input_error(
        "only {} ticks have both contact with sand and a recorded force, but a fit needs {}; lay the stroke "
        "deeper (stroke.depth), or name a stroke with forces",
        law.ticks(), least_ticks);
  if (law.recorded().isZero(0.0))
    throw_input_error("the recorded force is 0 in all {} ticks in contact, so there is nothing to fit",
                      law.ticks());
}

void check_limit(const FeltLaw& law, const VectorXd& values) {
  const Eigen::Matrix3Xd free = law.forces(values, DeviceLimit::ignored);
  const Eigen::Matrix3Xd limited = law.forces(values, DeviceLimit::applied);
  const Eigen::Index felt = (free.array() != 0.0).colwise().any().count();
  const Eigen::Index cut = (limited.array() != free.array()).colwise().any().count();
  if (cut > 0 && felt - cut < least_ticks)
    throw_input_error(
        "the device's limit (device.max_force = {:.4g} N) cuts the force in {} of {} ticks, so too few ticks "
        "show the constants; take a recording with smaller forces, or raise device.max_force if the "
        "recording had a higher limit",
        law.max_force(), cut, felt);
}

/// What all asked constants together say. Keeps the scene's value of a constant that the recording neither
/// determines nor contradicts.
void find_constants(LeastSquares& problem, ForceFit& fit) {
  const FeltLaw& law = problem.law;
  const std::vector<bool> asked = problem.is_free;
  fit.values = problem.best();
  check_limit(law, fit.values);
  const Confidence confidence(problem, fit.values);
  for (std::size_t constant = 0; constant < asked.size(); ++constant) {
    if (!asked[constant]) continue;
    if (interrupted()) return;
    const auto i = static_cast<Eigen::Index>(constant);
    FittedConstant one{law.constants()[constant], i, fit.values[i],
                       half(confidence.interval(constant, SlowWaves::within_68)),
                       confidence.interval(constant, SlowWaves::within_95)};
    one.kept = constant != 0 && !one.determined() &&  // 0 carries the scale
               confidence.distance(constant, law.start()[i]) <= SlowWaves::within_999;
    if (one.kept) one.error = std::numeric_limits<double>::infinity();
    problem.is_free[constant] = !one.kept;
    fit.constants.push_back(one);
  }
  if (problem.is_free == asked) return;
  fit.values = problem.best();
  const Confidence given(problem, fit.values);
  for (FittedConstant& one : fit.constants) {
    if (interrupted()) return;
    one.value = fit.values[one.index];
    if (!one.kept && !one.determined())
      one.given_error = half(given.interval(static_cast<std::size_t>(one.index), SlowWaves::within_68));
  }
}

}  // namespace

std::vector<bool> chosen_constants(std::span<const ForceConstant> constants,
                                   const std::vector<std::string>& names) {
  std::vector<bool> chosen;
  std::vector<std::string> all;
  for (const ForceConstant& one : constants) {
    all.emplace_back(one.name);
    chosen.push_back(names.empty() ? one.by_default
                                   : std::find(names.begin(), names.end(), all.back()) != names.end());
  }
  for (const std::string& name : names)
    if (std::find(all.begin(), all.end(), name) == all.end())
      throw_input_error("'{}' is not a constant of the scene's force.law; choose from {}", name,
                        fmt::join(all, ", "));
  return chosen;
}

ForceFit fit_force(const FeltLaw& law, const std::vector<bool>& asked) {
  check_enough(law);
  LeastSquares problem{law, law.recorded(), asked};
  ForceFit fit;
  fit.recorded_rms = rms(problem.recorded);
  find_constants(problem, fit);
  if (interrupted()) return fit;
  check_limit(law, fit.values);
  // A smaller change of the force [N] is not noticed.
  const double least_seen = std::max(0.01 * problem.residual(fit.values), 1e-6 * fit.recorded_rms);
  for (FittedConstant& one : fit.constants)
    one.acts = difference_rms(law, fit.values, without(fit.values, one.index)) > least_seen;
  fit.of_scale = law.scale();
  if (asked[0]) {
    fit.scale = scale_about(problem, asked, fit.values);
    fit.combination = problem.is_free == asked ? fit.scale : combination_about(problem, asked, fit.values);
  } else {
    fit.combination.powers = VectorXd::Zero(fit.values.size());
    fit.scale.value = law.numbers(fit.values)[0];
    fit.scale.error = std::numeric_limits<double>::quiet_NaN();
  }
  const Eigen::Matrix3Xd left = law.forces(fit.values, DeviceLimit::applied) - problem.recorded;
  const double ticks_apart = static_cast<double>(law.ticks()) / static_cast<double>(left.cols());
  fit.noise_length = static_cast<double>(correlation_length(left)) * ticks_apart * law.period();
  fit.ticks = law.ticks();
  fit.start_residual = problem.residual(law.start());
  fit.residual = problem.residual(fit.values);
  const auto explained_by = [&](double residual) {
    const double part = residual / fit.recorded_rms;
    return 1.0 - part * part;
  };
  fit.explained = explained_by(fit.residual);
  const LeastSquares reversed{law, -problem.recorded, asked};
  fit.explained_reversed = explained_by(reversed.residual(reversed.best()));
  return fit;
}

}  // namespace sandstroke
