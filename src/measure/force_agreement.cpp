#include "measure/force_agreement.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <spdlog/fmt/fmt.h>

#include "core/compensated_sum.h"

namespace sandstroke {
namespace {

using Eigen::Vector3d;

constexpr double most_lag = 0.5;                  // s
constexpr std::ptrdiff_t most_lags = 1'000;       // on each side; then as many as lie around the best
constexpr std::ptrdiff_t most_searched = 20'000;  // ticks, at each lag

/// Sums over ticks that have a run's force a and a recorded one b.
struct Moments {
  double ticks = 0.0, aa = 0.0, bb = 0.0, ab = 0.0;
  Vector3d a = Vector3d::Zero(), b = Vector3d::Zero();

  void add(const Vector3d& run, const Vector3d& recorded) {
    ticks += 1.0;
    a += run;
    b += recorded;
    aa += run.squaredNorm();
    bb += recorded.squaredNorm();
    ab += run.dot(recorded);
  }
  double correlation() const {
    const double run = aa - a.squaredNorm() / ticks, recorded = bb - b.squaredNorm() / ticks;
    const double least = 1e-12;  // the part of the squares that rounding leaves of a constant force
    if (!(run > least * aa) || !(recorded > least * bb)) return std::numeric_limits<double>::quiet_NaN();
    return (ab - a.dot(b) / ticks) / std::sqrt(run * recorded);
  }
};

/// Pairs the run's force `lag` ticks later with the recorded one, for every `stride`-th tick. Ticks that the
/// trace leaves out have no pair.
Moments moments(const std::vector<ForcePair>& ticks, std::ptrdiff_t lag, std::ptrdiff_t stride,
                double tick_seconds) {
  Moments sums;
  const auto count = static_cast<std::ptrdiff_t>(ticks.size());
  for (std::ptrdiff_t i = std::max<std::ptrdiff_t>(0, -lag); i < std::min(count, count - lag); i += stride) {
    const ForcePair& then = ticks[static_cast<std::size_t>(i)];
    const ForcePair& later = ticks[static_cast<std::size_t>(i + lag)];
    const double apart = later.time - then.time - static_cast<double>(lag) * tick_seconds;
    if (!std::isnan(then.recorded.x()) && std::abs(apart) < 0.5 * tick_seconds)
      sums.add(later.run, then.recorded);
  }
  return sums;
}

double shortest_step(const std::vector<ForcePair>& ticks) {
  double shortest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < ticks.size(); ++i)
    shortest = std::min(shortest, ticks[i].time - ticks[i - 1].time);
  return shortest;
}

/// Sets correlation, best_correlation and lag.
void correlate(const std::vector<ForcePair>& ticks, ForceAgreement& agreement) {
  if (ticks.size() < 2) return;
  const double tick_seconds = shortest_step(ticks);
  agreement.correlation = moments(ticks, 0, 1, tick_seconds).correlation();
  const auto count = static_cast<std::ptrdiff_t>(ticks.size());
  const auto most =
      static_cast<std::ptrdiff_t>(std::min(most_lag / tick_seconds, static_cast<double>(count)));
  const std::ptrdiff_t stride = 1 + count / most_searched;
  std::ptrdiff_t best = 0;
  // Tries lags on both sides of the middle, the nearest first; of equal correlations it keeps the first.
  const auto search = [&](std::ptrdiff_t middle, std::ptrdiff_t steps, std::ptrdiff_t step) {
    for (std::ptrdiff_t k = 0; k <= 2 * steps; ++k) {
      const std::ptrdiff_t lag = middle + (k % 2 == 0 ? step : -step) * ((k + 1) / 2);  // 0, -1, 1, -2, ...
      const Moments shifted = moments(ticks, lag, stride, tick_seconds);
      if (2.0 * shifted.ticks * static_cast<double>(stride) < static_cast<double>(agreement.ticks)) continue;
      if (shifted.correlation() <= agreement.best_correlation || std::isnan(shifted.correlation())) continue;
      agreement.best_correlation = shifted.correlation();
      best = lag;
    }
  };
  const std::ptrdiff_t coarse = 1 + most / most_lags;
  search(0, most / coarse, coarse);
  if (coarse > 1) search(best, coarse - 1, 1);
  if (std::abs(best) > most - coarse) {  // it still grows there, so that is no maximum
    agreement.best_correlation = agreement.correlation;
    best = 0;
  }
  agreement.lag = static_cast<double>(best) * tick_seconds;
}

}  // namespace

std::optional<ForceAgreement> force_agreement(const std::vector<ForcePair>& ticks) {
  ForceAgreement agreement;
  CompensatedSum squares;  // N^2
  for (const ForcePair& tick : ticks) {
    if (std::isnan(tick.recorded.x())) continue;
    const double apart = (tick.run - tick.recorded).norm();
    squares.add(apart * apart);
    agreement.max = std::max(agreement.max, apart);
    ++agreement.ticks;
  }
  if (agreement.ticks == 0) return std::nullopt;
  agreement.rms = std::sqrt(squares.value() / static_cast<double>(agreement.ticks));
  correlate(ticks, agreement);
  return agreement;
}

std::string text_of(const ForceAgreement& agreement) {
  std::string text = fmt::format("differs from the run's by {:.3g} N rms, {:.3g} N at most, over {} ticks",
                                 agreement.rms, agreement.max, agreement.ticks);
  if (std::isnan(agreement.correlation)) return text;
  text += fmt::format("; correlation {:.3f}", agreement.correlation);
  if (agreement.lag != 0.0)
    text += fmt::format(", {:.3f} if the run's force is read {:.1f} ms {}", agreement.best_correlation,
                        1e3 * std::abs(agreement.lag), agreement.lag > 0.0 ? "later" : "earlier");
  return text;
}

}  // namespace sandstroke
