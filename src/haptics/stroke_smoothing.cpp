#include "haptics/stroke_smoothing.h"

#include <Eigen/Sparse>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/elementary.h"
#include "core/error.h"
#include "haptics/stroke_pieces.h"

namespace sandstroke {
namespace {

using Eigen::Vector3d;
using Sparse = Eigen::SparseMatrix<double>;

/// The smallest (2 pi f h)^4. The solution's relative error is about 1e-16 of its inverse (measured: 2e-4).
constexpr double least_bend = 1e-12;

/// The mean rate [Hz].
double rate_of(const Stroke& stroke, const StrokePiece& piece) {
  return static_cast<double>(piece.size() - 1) / piece.duration(stroke.time);
}

bool is_filtered(const Stroke& stroke, const StrokePiece& piece, double cut_off) {
  return piece.size() >= 3 && rate_of(stroke, piece) >= 2.0 * cut_off;
}

/// The filter of one piece of samples. With Q the second divided differences, R the time between them and W
/// the time of each sample: (R^-1 + lambda Q^T W^-1 Q) g = Q^T y, x = y - lambda W^-1 Q g. Ends have W^-1 =
/// 0.
class PieceFilter {
 public:
  PieceFilter(const std::vector<double>& time, const StrokePiece& piece, double cut_off)
      : piece_(piece), inner_(static_cast<Eigen::Index>(piece.size()) - 2) {
    const auto step = [&](Eigen::Index i) {  // s, to the next sample
      const std::size_t at = piece.begin + static_cast<std::size_t>(i);
      return time[at + 1] - time[at];
    };
    const double mean_step = piece.duration(time) / static_cast<double>(piece.size() - 1);
    // Exact for even steps: a sine's second difference is (2 sin(pi f h) / h)^2 times the sine.
    const double bend = 2.0 * elementary::sin(std::numbers::pi * cut_off * mean_step) / mean_step;
    lambda_ = 1.0 / (bend * bend * bend * bend);

    Sparse q(inner_ + 2, inner_);
    std::vector<Eigen::Triplet<double>> entries;
    Eigen::VectorXd between(inner_);  // R^-1, s
    free_ = Eigen::VectorXd::Zero(inner_ + 2);
    for (Eigen::Index i = 0; i < inner_; ++i) {
      const double before = step(i), after = step(i + 1), mean = 0.5 * (before + after);
      entries.emplace_back(i, i, 1.0 / before);
      entries.emplace_back(i + 1, i, -1.0 / before - 1.0 / after);
      entries.emplace_back(i + 2, i, 1.0 / after);
      between[i] = mean;
      free_[i + 1] = 1.0 / mean;
    }
    q.setFromTriplets(entries.begin(), entries.end());
    differences_ = q.transpose();
    Sparse matrix = lambda_ * (differences_ * free_.asDiagonal() * q);
    matrix += Sparse(between.asDiagonal());
    solver_.compute(matrix);
  }

  void apply(std::vector<Vector3d>& column) const {
    Eigen::MatrixX3d rows(inner_ + 2, 3);
    for (Eigen::Index i = 0; i < rows.rows(); ++i)
      rows.row(i) = column[piece_.begin + static_cast<std::size_t>(i)].transpose();
    const Eigen::MatrixX3d bends = solver_.solve(differences_ * rows);
    rows -= lambda_ * (free_.asDiagonal() * (differences_.transpose() * bends));
    for (Eigen::Index i = 0; i < rows.rows(); ++i)
      column[piece_.begin + static_cast<std::size_t>(i)] = rows.row(i).transpose();
  }

 private:
  StrokePiece piece_;
  Eigen::Index inner_;
  double lambda_;         // s^4
  Sparse differences_;    // Q^T
  Eigen::VectorXd free_;  // W^-1, 1/s
  Eigen::SimplicialLDLT<Sparse, Eigen::Lower, Eigen::NaturalOrdering<int>> solver_;
};

}  // namespace

bool is_smoothed(const Stroke& stroke, double cut_off) {
  const std::vector<StrokePiece> pieces = joined_pieces(stroke);
  return std::any_of(pieces.begin(), pieces.end(),
                     [&](const StrokePiece& piece) { return is_filtered(stroke, piece, cut_off); });
}

Stroke smoothed(const Stroke& stroke, double cut_off) {
  Stroke smooth = stroke;
  for (const StrokePiece& piece : joined_pieces(stroke)) {
    if (!is_filtered(stroke, piece, cut_off)) continue;
    const double rate = rate_of(stroke, piece);
    const double turn = 2.0 * std::numbers::pi * cut_off / rate, square = turn * turn;
    if (square * square < least_bend)
      throw_input_error(
          "stroke.smooth = {:.4g} Hz is too low for samples at {:.6g} Hz: rounding errors would displace "
          "them; set {:.2g} Hz or more",
          cut_off, rate, 1.01 * rate * std::sqrt(std::sqrt(least_bend)) / (2.0 * std::numbers::pi));
    const PieceFilter filter(stroke.time, piece, cut_off);
    filter.apply(smooth.position);
    if (!smooth.velocity.empty()) filter.apply(smooth.velocity);
  }
  return smooth;
}

}  // namespace sandstroke
