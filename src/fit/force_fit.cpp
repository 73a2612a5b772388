#include "fit/force_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <unsupported/Eigen/NonLinearOptimization>
#include <unsupported/Eigen/NumericalDiff>

#include "core/error.h"

namespace sandstroke {
namespace {

using Eigen::VectorXd;

constexpr std::size_t stretches = 10, least_ticks = 100;
constexpr std::size_t most_ticks = 50'000;  // evenly chosen: more say little more

/// Which constants are free, and the numbers that stand for them: the roots of k_s k_c, k_c and k_f, so that
/// none becomes negative. k_s alone is badly known where k_c d is small, for the force is nearly k_s k_c d.
class Parameters {
 public:
  Parameters(const ForceSettings& start, const std::array<bool, 3>& is_free)
      : start_(start), is_free_(is_free) {}

  Eigen::Index count() const { return std::count(is_free_.begin(), is_free_.end(), true); }

  VectorXd of(const ForceSettings& force) const {
    const std::array<double, 3> all = {force.k_s * force.k_c, force.k_c, force.k_f};
    VectorXd free(count());
    Eigen::Index next = 0;
    for (std::size_t i = 0; i < 3; ++i)
      if (is_free_[i]) free[next++] = std::sqrt(std::max(all[i], least[i]));
    return free;
  }

  ForceSettings force(const VectorXd& free) const {
    Eigen::Index next = 0;
    const auto value = [&](std::size_t i, double kept) {
      if (!is_free_[i]) return kept;
      const double root = free[next++];
      return root * root;
    };
    ForceSettings force = start_;
    const double stiffness = value(0, 0.0);
    force.k_c = std::max(value(1, start_.k_c), least[1]);
    if (is_free_[0]) force.k_s = stiffness / force.k_c;
    force.k_f = value(2, start_.k_f);
    return force;
  }

 private:
  // A root of 0 would stay there, for its square does not change at first order.
  static constexpr std::array<double, 3> least = {1e-6, 1e-6, 1e-6};

  ForceSettings start_;
  std::array<bool, 3> is_free_;  // k_s, k_c, k_f
};

/// What is left of the recorded force, in every component.
struct Residuals {
  using Scalar = double;
  using InputType = VectorXd;
  using ValueType = VectorXd;
  using JacobianType = Eigen::MatrixXd;
  enum { InputsAtCompileTime = Eigen::Dynamic, ValuesAtCompileTime = Eigen::Dynamic };

  const std::vector<FeltTick>& ticks;
  const Parameters& parameters;
  double max_force;

  int inputs() const { return static_cast<int>(parameters.count()); }
  int values() const { return static_cast<int>(3 * ticks.size()); }
  int operator()(const VectorXd& free, VectorXd& left) const {
    const ForceSettings force = parameters.force(free);
    Eigen::Index row = 0;
    for (const FeltTick& tick : ticks) {
      left.segment<3>(row) = sand_force(tick.depth, tick.velocity, max_force, force).total - tick.recorded;
      row += 3;
    }
    return left.allFinite() ? 0 : -1;
  }
};

ForceSettings fitted(const std::vector<FeltTick>& ticks, const ForceSettings& start, double max_force,
                     const std::array<bool, 3>& is_free) {
  const Parameters parameters(start, is_free);
  VectorXd free = parameters.of(start);
  if (free.size() == 0) return start;
  Eigen::NumericalDiff<Residuals, Eigen::Central> residuals(Residuals{ticks, parameters, max_force});
  Eigen::LevenbergMarquardt<decltype(residuals)> solver(residuals);
  solver.parameters.xtol = solver.parameters.ftol = 1e-12;
  solver.minimize(free);
  return parameters.force(free);
}

double residual_rms(const std::vector<FeltTick>& ticks, const ForceSettings& force, double max_force) {
  double squares = 0.0;
  for (const FeltTick& tick : ticks)
    squares += (sand_force(tick.depth, tick.velocity, max_force, force).total - tick.recorded).squaredNorm();
  return std::sqrt(squares / static_cast<double>(ticks.size()));
}

/// The best of the fits from `start` and from weak sand: where the device's limit cuts every force, no
/// constant changes any, and a fit would stay where it began.
ForceSettings best_fitted(const std::vector<FeltTick>& ticks, const ForceSettings& start, double max_force,
                          const std::array<bool, 3>& is_free) {
  constexpr double weak_k_s = 1e-3, weak_k_f = 1e-2;  // N, s/m: a drag below any limit
  ForceSettings weak = start;
  if (is_free[0]) weak.k_s = std::min(start.k_s, weak_k_s);
  if (is_free[2]) weak.k_f = std::min(start.k_f, weak_k_f);
  const ForceSettings from_start = fitted(ticks, start, max_force, is_free),
                      from_weak = fitted(ticks, weak, max_force, is_free);
  return residual_rms(ticks, from_weak, max_force) < residual_rms(ticks, from_start, max_force) ? from_weak
                                                                                                : from_start;
}

ForceSettings without(ForceSettings force, const ForceConstant& constant) {
  force.*constant.value = 0.0;
  return force;
}

/// N, by which two forces differ, without the device's limit.
double difference_rms(const std::vector<FeltTick>& ticks, const ForceSettings& one,
                      const ForceSettings& other) {
  double squares = 0.0;
  for (const FeltTick& tick : ticks)
    squares += (sand_force(tick.depth, tick.velocity, 0.0, one).total -
                sand_force(tick.depth, tick.velocity, 0.0, other).total)
                   .squaredNorm();
  return std::sqrt(squares / static_cast<double>(ticks.size()));
}

/// N, by which k_c changes the force from one that is straight in the depth, with the same k_s k_c.
double bend_rms(const std::vector<FeltTick>& ticks, const ForceSettings& force) {
  ForceSettings straight = force;
  straight.k_c *= 1e-4;
  straight.k_s *= 1e4;
  return difference_rms(ticks, force, straight);
}

/// How many have a force that the device's limit does not cut.
std::size_t ticks_within(double max_force, const std::vector<FeltTick>& ticks, const ForceSettings& force) {
  constexpr double no_limit = 0.0;
  if (max_force == no_limit) return ticks.size();
  return static_cast<std::size_t>(std::count_if(ticks.begin(), ticks.end(), [&](const FeltTick& tick) {
    return sand_force(tick.depth, tick.velocity, no_limit, force).total.norm() < max_force;
  }));
}

/// All but one stretch.
std::vector<FeltTick> without(const std::vector<FeltTick>& ticks, std::size_t stretch) {
  std::vector<FeltTick> kept;
  for (std::size_t i = 0; i < ticks.size(); ++i)
    if (i * stretches / ticks.size() != stretch) kept.push_back(ticks[i]);
  return kept;
}

double jackknife_error(const std::array<double, stretches>& values) {
  double mean = 0.0, squares = 0.0;
  for (const double value : values) mean += value / stretches;
  for (const double value : values) squares += (value - mean) * (value - mean);
  return std::sqrt(squares * (stretches - 1.0) / stretches);
}

/// A fit of some constants with the errors of all, and of k_s k_c.
struct Estimate {
  ForceSettings force;
  std::array<double, 3> error{};
  double stiffness_error = 0.0;
};

Estimate estimate(const std::vector<FeltTick>& ticks, const ForceSettings& start, double max_force,
                  const std::array<bool, 3>& is_free) {
  Estimate found{best_fitted(ticks, start, max_force, is_free)};
  std::array<std::array<double, stretches>, 3> values{};
  std::array<double, stretches> stiffness{};
  for (std::size_t k = 0; k < stretches; ++k) {
    const ForceSettings other = fitted(without(ticks, k), found.force, max_force, is_free);
    for (std::size_t i = 0; i < 3; ++i) values[i][k] = other.*force_constants[i].value;
    stiffness[k] = other.k_s * other.k_c;
  }
  for (std::size_t i = 0; i < 3; ++i) found.error[i] = jackknife_error(values[i]);
  found.stiffness_error = jackknife_error(stiffness);
  return found;
}

std::vector<FeltTick> evenly_chosen(const std::vector<FeltTick>& ticks) {
  if (ticks.size() <= most_ticks) return ticks;
  std::vector<FeltTick> chosen;
  for (std::size_t i = 0; i < most_ticks; ++i) chosen.push_back(ticks[i * ticks.size() / most_ticks]);
  return chosen;
}

std::array<bool, 3> chosen_constants(const std::vector<std::string>& names) {
  std::array<bool, 3> is_free{};
  for (const std::string& name : names) {
    const auto found = std::find_if(std::begin(force_constants), std::end(force_constants),
                                    [&](const ForceConstant& one) { return one.name == name; });
    if (found == std::end(force_constants))
      throw_input_error("'{}' is no constant of the force; take some of k_s, k_c, k_f", name);
    is_free[static_cast<std::size_t>(found - std::begin(force_constants))] = true;
  }
  return is_free;
}

}  // namespace

ForceFit fit_force(const std::vector<FeltTick>& all, const ForceSettings& start, double max_force,
                   const std::vector<std::string>& names) {
  const std::array<bool, 3> asked = chosen_constants(names);
  if (all.size() < least_ticks)
    throw_input_error(
        "in {} ticks the tool touches sand and has a recorded force, and a fit takes {}; lay the stroke "
        "deeper "
        "(stroke.depth), or name one with forces",
        all.size(), least_ticks);
  const std::vector<FeltTick> ticks = evenly_chosen(all);
  std::array<bool, 3> is_free = asked;
  const double recorded_rms = residual_rms(ticks, without(start, force_constants[0]), max_force);
  if (recorded_rms == 0.0)
    throw_input_error("the recorded force is 0 in all {} ticks in contact, so there is nothing to fit",
                      all.size());
  // N, below which a change of the force is not noticed.
  const auto least_seen = [&](const ForceSettings& force) {
    return std::max(0.01 * residual_rms(ticks, force, max_force), 1e-6 * recorded_rms);
  };
  Estimate found = estimate(ticks, start, max_force, is_free);
  const auto only_product = [&] {
    return !(found.error[1] < found.force.k_c) || bend_rms(ticks, found.force) < least_seen(found.force);
  };
  if (is_free[1] && only_product()) {
    is_free[1] = false;
    found = estimate(ticks, start, max_force, is_free);
  }

  if (const std::size_t free = ticks_within(max_force, ticks, found.force); free < least_ticks)
    throw_input_error(
        "the device's limit (device.max_force = {:.4g} N) cuts the force in {} of {} ticks, so its constants "
        "hardly show; take a recording with smaller forces, or raise the limit if the recording had another",
        max_force, ticks.size() - free, ticks.size());

  ForceFit fit;
  fit.force = found.force;
  for (std::size_t i = 0; i < 3; ++i)
    if (asked[i])
      fit.constants.push_back({force_constants[i], found.force.*force_constants[i].value,
                               is_free[i] ? found.error[i] : std::numeric_limits<double>::infinity(),
                               difference_rms(ticks, found.force, without(found.force, force_constants[i])) >
                                   least_seen(found.force)});
  fit.stiffness = found.force.k_s * found.force.k_c;
  fit.stiffness_error = found.stiffness_error;
  fit.ticks = static_cast<std::int64_t>(all.size());
  fit.recorded_rms = recorded_rms;
  fit.start_residual = residual_rms(ticks, start, max_force);
  fit.residual = residual_rms(ticks, fit.force, max_force);
  const auto share = [&](double residual) {
    const double part = residual / fit.recorded_rms;
    return 1.0 - part * part;
  };
  fit.explained = share(fit.residual);
  std::vector<FeltTick> reversed = ticks;
  for (FeltTick& tick : reversed) tick.recorded = -tick.recorded;
  fit.explained_reversed =
      share(residual_rms(reversed, best_fitted(reversed, start, max_force, asked), max_force));
  return fit;
}

}  // namespace sandstroke
