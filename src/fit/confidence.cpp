#include "fit/confidence.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "core/elementary.h"

namespace sandstroke {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// The part of a force that a sum of these others cannot make.
VectorXd beside(const MatrixXd& others, const VectorXd& force) {
  if (others.cols() == 0) return force;
  return force - others * others.colPivHouseholderQr().solve(force);
}

/// The growth of the force with the logarithm of each number, a column for each.
MatrixXd growth_of_force(const FeltLaw& law, const VectorXd& values) {
  constexpr double step = 1e-4;
  const VectorXd numbers = law.numbers(values);
  const auto forces_of = [&](Index i, double factor) {
    VectorXd changed = numbers;
    changed[i] *= factor;
    return law.forces(law.values(changed), DeviceLimit::applied);
  };
  MatrixXd growth(law.recorded().size(), numbers.size());
  for (Index i = 0; i < numbers.size(); ++i)  // on both sides: the force may bend just there
    growth.col(i) = (forces_of(i, 1.0 + step) - forces_of(i, 1.0 - step)).reshaped() / (2.0 * step);
  return growth;
}

std::vector<Index> marked(const std::vector<bool>& are) {
  std::vector<Index> indices;
  for (std::size_t i = 0; i < are.size(); ++i)
    if (are[i]) indices.push_back(static_cast<Index>(i));
  return indices;
}

Combination with_powers(const LeastSquares& problem, const std::vector<bool>& asked, const VectorXd& values,
                        const MatrixXd& growth, const VectorXd& powers) {
  MatrixXd others(growth.rows(), std::count(asked.begin() + 1, asked.end(), true));
  Index next = 0;
  for (Index i = 1; i < growth.cols(); ++i)
    if (asked[static_cast<std::size_t>(i)]) others.col(next++) = growth.col(i) - powers[i] * growth.col(0);
  const Eigen::Matrix3Xd left = problem.law.forces(values, DeviceLimit::applied) - problem.recorded;
  const VectorXd own = beside(others, growth.col(0));
  const double per_growth = 1.0 / own.squaredNorm();
  const Eigen::Matrix3Xd direction = Eigen::Matrix3Xd::Map(own.data(), 3, left.cols());
  const SlowWaves waves(growth(Eigen::all, marked(problem.is_free)));
  const double scale = problem.law.numbers(values)[0];
  // The step to the best values with nothing kept, and without bounds: a bound would bias the scale.
  return {powers, scale * elementary::exp(-direction.cwiseProduct(left).sum() * per_growth),
          scale * SlowWaves::within_68 * waves.error_of_sum(direction, left) * per_growth};
}

}  // namespace

Confidence::Confidence(const LeastSquares& problem, VectorXd best)
    : problem_(problem),
      best_(std::move(best)),
      force_(problem.law.forces(best_, DeviceLimit::applied)),
      left_(force_ - problem.recorded),
      waves_(growth_of_force(problem.law, best_)(Eigen::all, marked(problem.is_free))) {}

double Confidence::distance(std::size_t constant, double value) const {
  LeastSquares others = problem_;
  others.is_free[constant] = false;
  VectorXd from = problem_.law.with(best_, constant, value);
  for (std::size_t i = 0; i < others.is_free.size(); ++i)
    if (i != constant && !others.is_free[i]) from[static_cast<Index>(i)] = best_[static_cast<Index>(i)];
  const VectorXd rival = others.solved(from);
  const Eigen::Matrix3Xd change = problem_.law.forces(rival, DeviceLimit::applied) - force_;
  const double farther = change.cwiseProduct(change + left_).sum();
  if (!std::isfinite(farther))
    return std::numeric_limits<double>::infinity();  // no number holds such a force
  return farther > 0.0 ? farther / waves_.error_of_sum(change, left_) : 0.0;
}

Interval Confidence::interval(std::size_t constant, double distance) const {
  constexpr double beyond = 1e4;  // times any value that was thought of
  constexpr double small = 1e-2;  // in the constant's unit, where these are all 0
  const auto i = static_cast<Index>(constant);
  const auto [least, most] = problem_.law.range(constant);
  const double start = problem_.law.start()[i], larger = std::max({best_[i], start, least, small});
  // A fit may end at a value that is as good as 0.
  const double smaller = std::max(std::min(best_[i], start), larger / (beyond * beyond));
  return {end(constant, std::max(least, smaller / beyond), 0.0, distance),
          end(constant, std::min(most, larger * beyond), std::numeric_limits<double>::infinity(), distance)};
}

/// Searches between the best value and the outermost; `open` is the end, 0 or infinity, if that one is not
/// far enough. Steps grow, guided by the distances so far; then a secant, or else halving, closes in.
double Confidence::end(std::size_t constant, double outermost, double open, double distance) const {
  constexpr double first_step = 0.01, longest = 10.0, shortest = 1.5, tolerance = 0.02, least_step = 1e-6;
  const bool upwards = open > 0.0;
  const double best = std::max(best_[static_cast<Index>(constant)], std::numeric_limits<double>::min());
  const double whole = upwards ? std::log(outermost / best) : std::log(best / outermost);
  if (!(whole > 0.0)) return open;  // the best value stands for it
  struct Point {
    double step, distance;
  };
  const auto value_at = [&](double step) { return best * elementary::exp(upwards ? step : -step); };
  const auto at = [&](double step) { return Point{step, this->distance(constant, value_at(step))}; };
  // Where sand ceases to slide along a tool, more friction may fit again.
  const auto fits_again = [&](double step) -> std::optional<Point> {
    while (step < whole) {
      step = std::min(2.0 * step, whole);
      if (const Point beyond = at(step); beyond.distance < distance) return beyond;
    }
    return std::nullopt;
  };
  Point inside{0.0, 0.0}, outside{};
  for (double step = first_step;;) {
    outside = at(std::min(step, whole));
    if (outside.distance >= distance) {
      const std::optional<Point> again = fits_again(outside.step);
      if (!again) break;
      outside = *again;
    }
    if (outside.step == whole) return open;
    inside = outside;
    const double wanted = (1.0 + 0.5 * tolerance) * distance / std::max(inside.distance, distance / longest);
    step = inside.step * std::clamp(wanted, shortest, longest);
  }
  bool secant = true;
  while (outside.distance > (1.0 + tolerance) * distance && outside.step - inside.step > least_step) {
    const double part = secant ? (distance - inside.distance) / (outside.distance - inside.distance) : 0.5;
    secant = !secant;
    const Point between = at(inside.step + part * (outside.step - inside.step));
    (between.distance < distance ? inside : outside) = between;
  }
  return value_at(outside.step);
}

Combination combination_about(const LeastSquares& problem, const std::vector<bool>& asked,
                              const VectorXd& values) {
  const MatrixXd growth = growth_of_force(problem.law, values);
  std::vector<bool> fitted = problem.is_free;
  fitted[0] = true;
  const auto solver = MatrixXd(growth(Eigen::all, marked(fitted))).colPivHouseholderQr();
  VectorXd powers = VectorXd::Zero(values.size());
  for (std::size_t i = 1; i < asked.size(); ++i)
    if (asked[i] && !problem.is_free[i]) {
      const auto kept = static_cast<Index>(i);
      powers[kept] = 0.01 * std::round(100.0 * solver.solve(growth.col(kept))[0]) + 0.0;  // no -0
    }
  return with_powers(problem, asked, values, growth, powers);
}

Combination scale_about(const LeastSquares& problem, const std::vector<bool>& asked, const VectorXd& values) {
  return with_powers(problem, asked, values, growth_of_force(problem.law, values),
                     VectorXd::Zero(values.size()));
}

}  // namespace sandstroke
