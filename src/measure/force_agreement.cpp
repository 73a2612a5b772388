#include "measure/force_agreement.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <spdlog/fmt/fmt.h>

#include "core/compensated_sum.h"

namespace sandstroke {
namespace {

constexpr double most_lag = 0.5;  // s

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
  agreement.correlation = agreement.best_correlation = moments_at(ticks, tick_seconds, 0).correlation();
  if (std::isnan(agreement.correlation)) return;
  const auto most =
      static_cast<std::ptrdiff_t>(std::min(most_lag / tick_seconds, static_cast<double>(ticks.size())));
  const std::vector<Moments> found = lagged_moments(ticks, tick_seconds, most);
  double most_ticks = 0.0;
  for (const Moments& moments : found) most_ticks = std::max(most_ticks, moments.ticks);
  std::ptrdiff_t best = 0;
  double largest = agreement.correlation;
  for (std::ptrdiff_t k = 1; k <= 2 * most; ++k) {
    const std::ptrdiff_t lag = (k % 2 == 0 ? 1 : -1) * ((k + 1) / 2);  // the nearest first: -1, 1, -2, ...
    const Moments& moments = found[static_cast<std::size_t>(lag + most)];
    constexpr double rounding = 1e-9;  // of equal correlations the nearest counts
    if (2.0 * moments.ticks < most_ticks || !(moments.correlation() > largest + rounding)) continue;
    largest = moments.correlation();
    best = lag;
  }
  if (best == 0 || std::abs(best) == most) return;  // where it still grows, there is no maximum
  agreement.best_correlation = moments_at(ticks, tick_seconds, best).correlation();
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
