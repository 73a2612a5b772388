#include "fit/least_squares.h"

#include <algorithm>
#include <cmath>
#include <unsupported/Eigen/NonLinearOptimization>
#include <unsupported/Eigen/NumericalDiff>

namespace sandstroke {
namespace {

using Eigen::VectorXd;

/// The square roots of the free numbers. A fit changes these, so that no number becomes negative.
class FreeRoots {
 public:
  FreeRoots(const LeastSquares& problem, const VectorXd& from)
      : problem_(problem), from_(from), numbers_(problem.law.numbers(from)) {}

  VectorXd roots() const {
    constexpr double least = 1e-6;  // a root of 0 would stay there, because its square has no slope
    VectorXd roots(std::count(problem_.is_free.begin(), problem_.is_free.end(), true));
    Eigen::Index next = 0;
    for (std::size_t i = 0; i < problem_.is_free.size(); ++i)
      if (problem_.is_free[i])
        roots[next++] = std::sqrt(std::max(numbers_[static_cast<Eigen::Index>(i)], least));
    return roots;
  }

  VectorXd values(const VectorXd& roots) const {
    VectorXd numbers = numbers_;
    Eigen::Index next = 0;
    for (std::size_t i = 0; i < problem_.is_free.size(); ++i)
      if (problem_.is_free[i]) {
        const double root = roots[next++];
        numbers[static_cast<Eigen::Index>(i)] = root * root;
      }
    VectorXd values = problem_.law.values(numbers);
    for (std::size_t i = 0; i < problem_.is_free.size(); ++i)
      if (!problem_.is_free[i]) values[static_cast<Eigen::Index>(i)] = from_[static_cast<Eigen::Index>(i)];
    return values;
  }

 private:
  const LeastSquares& problem_;
  VectorXd from_, numbers_;
};

/// The law's force minus the recorded one, in every component.
struct Residuals {
  using Scalar = double;
  using InputType = VectorXd;
  using ValueType = VectorXd;
  using JacobianType = Eigen::MatrixXd;
  enum { InputsAtCompileTime = Eigen::Dynamic, ValuesAtCompileTime = Eigen::Dynamic };

  const LeastSquares& problem;
  const FreeRoots& free;

  int inputs() const { return static_cast<int>(free.roots().size()); }
  int values() const { return static_cast<int>(problem.recorded.size()); }
  int operator()(const VectorXd& roots, VectorXd& left) const {
    left = (problem.law.forces(free.values(roots), DeviceLimit::applied) - problem.recorded).reshaped();
    return left.allFinite() ? 0 : -1;
  }
};

}  // namespace

double rms(const Eigen::Matrix3Xd& forces) {
  double squares = 0.0;
  for (const auto& force : forces.colwise()) squares += force.squaredNorm();
  return std::sqrt(squares / static_cast<double>(forces.cols()));
}

double LeastSquares::residual(const VectorXd& values) const {
  return rms(law.forces(values, DeviceLimit::applied) - recorded);
}

VectorXd LeastSquares::solved(const VectorXd& from) const {
  const FreeRoots free(*this, from);
  VectorXd roots = free.roots();
  if (roots.size() == 0) return from;
  Eigen::NumericalDiff<Residuals, Eigen::Central> residuals(Residuals{*this, free});
  Eigen::LevenbergMarquardt<decltype(residuals)> solver(residuals);
  solver.parameters.xtol = solver.parameters.ftol = 1e-12;
  solver.minimize(roots);
  return free.values(roots);
}

VectorXd LeastSquares::best() const {
  VectorXd weak = law.weak();
  for (std::size_t i = 0; i < is_free.size(); ++i)
    if (!is_free[i]) weak[static_cast<Eigen::Index>(i)] = law.start()[static_cast<Eigen::Index>(i)];
  const VectorXd from_start = solved(law.start()), from_weak = solved(weak);
  return residual(from_weak) < residual(from_start) ? from_weak : from_start;
}

}  // namespace sandstroke
