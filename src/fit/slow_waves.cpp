#include "fit/slow_waves.h"

#include <Eigen/QR>
#include <cmath>
#include <numbers>

#include "core/elementary.h"

namespace sandstroke {

SlowWaves::SlowWaves(const Eigen::MatrixXd& fitted) : waves_(fitted.rows() / 3, count) {
  fitted_.resize(fitted.rows(), 0);
  if (fitted.cols() > 0) {
    const auto solver = fitted.colPivHouseholderQr();
    fitted_ = solver.householderQ() * Eigen::MatrixXd::Identity(fitted.rows(), solver.rank());
  }
  for (Eigen::Index k = 0; k < count; ++k)
    for (Eigen::Index i = 0; i < waves_.rows(); ++i)
      waves_(i, k) = elementary::cos(std::numbers::pi * static_cast<double>(k + 1) *
                                     (static_cast<double>(i) + 0.5) / static_cast<double>(waves_.rows()));
}

double SlowWaves::error_of_sum(const Eigen::Matrix3Xd& direction, const Eigen::Matrix3Xd& noise) const {
  double squares = 0.0;
  for (const auto& wave : waves_.colwise()) {
    const Eigen::VectorXd along = (direction * wave.asDiagonal()).reshaped();
    const double sum = along.dot(noise.reshaped()), all = along.squaredNorm(),
                 left = all - (fitted_.transpose() * along).squaredNorm();
    constexpr double rounding = 1e-12;
    if (left > rounding * all) squares += sum * sum / left;
  }
  return std::sqrt(direction.squaredNorm() * squares / count);
}

Eigen::Index correlation_length(const Eigen::Matrix3Xd& noise) {
  const double uncorrelated = noise.squaredNorm() / std::numbers::e;
  const auto is_alike = [&](Eigen::Index apart) {
    const Eigen::Index pairs = noise.cols() - apart;
    return noise.leftCols(pairs).cwiseProduct(noise.rightCols(pairs)).sum() > uncorrelated;
  };
  Eigen::Index alike = 0, apart = 1;
  while (apart < noise.cols() && is_alike(apart)) {
    alike = apart;
    apart *= 2;
  }
  while (apart - alike > 1) {
    const Eigen::Index middle = (alike + apart) / 2;
    (middle < noise.cols() && is_alike(middle) ? alike : apart) = middle;
  }
  return alike;
}

}  // namespace sandstroke
