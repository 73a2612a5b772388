#include "fit/force_fit.h"

#include <spdlog/fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/error.h"
#include "fit/least_squares.h"

namespace sandstroke {
namespace {

using Eigen::VectorXd;

constexpr Eigen::Index stretches = 10, least_ticks = 100;

double jackknife_error(const VectorXd& values) {
  const double squares = (values.array() - values.mean()).square().sum();
  return std::sqrt(squares * (stretches - 1.0) / stretches);
}

/// A fit, and the errors of all its values and of the scale.
struct Estimate {
  VectorXd values, error;
  double scale_error = 0.0;
};

Eigen::Index begin_of(Eigen::Index stretch, Eigen::Index ticks) {
  return (stretch * ticks + stretches - 1) / stretches;
}

Estimate estimate(const LeastSquares& problem) {
  Estimate found{problem.best(), VectorXd::Zero(problem.law.start().size())};
  Eigen::MatrixXd others(found.values.size(), stretches);
  VectorXd scales(stretches);
  const Eigen::Index ticks = problem.recorded.cols();
  for (Eigen::Index k = 0; k < stretches; ++k) {
    others.col(k) = problem.solved(found.values, {begin_of(k, ticks), begin_of(k + 1, ticks)});
    scales[k] = problem.law.numbers(others.col(k))[0];
  }
  for (Eigen::Index i = 0; i < found.error.size(); ++i) found.error[i] = jackknife_error(others.row(i));
  found.scale_error = jackknife_error(scales);
  return found;
}

/// The root mean square [N] of the difference of two forces, without the device's limit.
double difference_rms(const FeltLaw& law, const VectorXd& one, const VectorXd& other) {
  return rms(law.forces(one, DeviceLimit::ignored) - law.forces(other, DeviceLimit::ignored));
}

/// True if this value of a constant, with the others fitted anew, leaves clearly more of the force: the
/// difference of squares is larger than its standard error between stretches. That is two standard errors of
/// the constant.
bool fits_worse(LeastSquares problem, const VectorXd& best, Eigen::Index constant, double value) {
  VectorXd rival = best;
  rival[constant] = value;
  problem.is_free[static_cast<std::size_t>(constant)] = false;
  rival = problem.solved(rival);
  const auto squares = [&](const VectorXd& values) -> VectorXd {
    return (problem.law.forces(values, DeviceLimit::applied) - problem.recorded).colwise().squaredNorm();
  };
  const VectorXd more = squares(rival) - squares(best);
  VectorXd sums(stretches);
  for (Eigen::Index k = 0; k < stretches; ++k) {
    const Eigen::Index begin = begin_of(k, more.size());
    sums[k] = more.segment(begin, begin_of(k + 1, more.size()) - begin).sum();
  }
  const double variance = (sums.array() - sums.mean()).square().sum() * stretches / (stretches - 1.0);
  return sums.sum() > std::sqrt(variance);
}

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
  // A smaller change of the force [N] is not noticed.
  const auto least_seen = [&](const VectorXd& values) {
    return std::max(0.01 * problem.residual(values), 1e-6 * fit.recorded_rms);
  };
  Estimate found = estimate(problem);
  const auto is_known = [&](std::size_t constant) {
    const std::vector<VectorXd> rivals = law.rivals(found.values, constant);
    const std::vector<double> extremes = law.extremes(constant);
    const auto i = static_cast<Eigen::Index>(constant);
    if (rivals.empty() && extremes.empty()) return true;
    return found.error[i] < found.values[i] &&
           std::none_of(rivals.begin(), rivals.end(),
                        [&](const VectorXd& rival) {
                          return difference_rms(law, found.values, rival) < least_seen(found.values);
                        }) &&
           std::all_of(extremes.begin(), extremes.end(),
                       [&](double extreme) { return fits_worse(problem, found.values, i, extreme); });
  };
  std::vector<bool> known = asked;
  for (std::size_t i = 0; i < asked.size(); ++i) known[i] = asked[i] && is_known(i);
  problem.is_free = known;
  if (problem.is_free != asked) found = estimate(problem);
  check_limit(law, found.values);

  fit.values = found.values;
  for (std::size_t constant = 0; constant < asked.size(); ++constant) {
    if (!asked[constant]) continue;
    const auto i = static_cast<Eigen::Index>(constant);
    fit.constants.push_back(
        {law.constants()[constant], found.values[i],
         problem.is_free[constant] ? found.error[i] : std::numeric_limits<double>::infinity(),
         difference_rms(law, found.values, without(found.values, i)) > least_seen(found.values)});
  }
  fit.of_scale = law.scale();
  fit.scale = law.numbers(found.values)[0];
  fit.scale_error = found.scale_error;
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
