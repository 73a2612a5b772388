#include "measure/lagged_moments.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <unsupported/Eigen/FFT>

namespace sandstroke {
namespace {

/// A force on every tick of a stretch: x, y, z, its square, and 1; all 0 where there is none.
using Channels = std::array<std::vector<double>, 5>;
enum { x, y, z, square, one };

void put(Channels& channels, std::size_t at, const Eigen::Vector3d& force) {
  for (const int axis : {x, y, z}) channels[axis][at] = force[axis];
  channels[square][at] = force.squaredNorm();
  channels[one][at] = 1.0;
}

/// Products of the channels of a run and of a recording, summed over a stretch: one of Moments each.
enum { ticks_, aa_, bb_, ab_, a_, b_ = a_ + 3, sums = b_ + 3 };
using Spectrum = Eigen::ArrayXcd;

/// Adds up, at all lags, what stretches of ticks give.
class LaggedSums {
 public:
  LaggedSums(std::size_t length, std::ptrdiff_t most) : length_(length), most_(most) {
    fft_.SetFlag(Eigen::FFT<double>::HalfSpectrum);
    for (Spectrum& sum : sums_) sum = Spectrum::Zero(static_cast<Eigen::Index>(length / 2 + 1));
  }

  /// The run's channels begin `most` ticks before those of the recording, and go as far beyond.
  void add(const Channels& run, const Channels& recorded) {
    std::array<Spectrum, 5> a, b;
    for (std::size_t k = 0; k < a.size(); ++k) {
      a[k] = transformed(run[k]);
      b[k] = transformed(recorded[k]).conjugate();
    }
    sums_[ticks_] += a[one] * b[one];
    sums_[aa_] += a[square] * b[one];
    sums_[bb_] += a[one] * b[square];
    for (const int axis : {x, y, z}) {
      sums_[ab_] += a[axis] * b[axis];
      sums_[a_ + axis] += a[axis] * b[one];
      sums_[b_ + axis] += a[one] * b[axis];
    }
  }

  std::vector<Moments> moments() {
    std::array<std::vector<double>, sums> at;
    for (int k = 0; k < sums; ++k) {
      at[k].resize(length_);
      fft_.inv(at[k].data(), sums_[k].data(), static_cast<Eigen::Index>(length_));
    }
    std::vector<Moments> found(static_cast<std::size_t>(2 * most_ + 1));
    for (std::size_t i = 0; i < found.size(); ++i)
      found[i] = {std::round(at[ticks_][i]),
                  at[aa_][i],
                  at[bb_][i],
                  at[ab_][i],
                  {at[a_][i], at[a_ + 1][i], at[a_ + 2][i]},
                  {at[b_][i], at[b_ + 1][i], at[b_ + 2][i]}};
    return found;
  }

 private:
  Spectrum transformed(const std::vector<double>& channel) {
    Spectrum spectrum(static_cast<Eigen::Index>(length_ / 2 + 1));
    fft_.fwd(spectrum.data(), channel.data(), static_cast<Eigen::Index>(length_));
    return spectrum;
  }

  std::size_t length_;
  std::ptrdiff_t most_;
  Eigen::FFT<double> fft_;
  std::array<Spectrum, sums> sums_;
};

}  // namespace

void Moments::add(const Eigen::Vector3d& run, const Eigen::Vector3d& recorded) {
  ticks += 1.0;
  a += run;
  b += recorded;
  aa += run.squaredNorm();
  bb += recorded.squaredNorm();
  ab += run.dot(recorded);
}

double Moments::correlation() const {
  const double run = aa - a.squaredNorm() / ticks, recorded = bb - b.squaredNorm() / ticks;
  const double least = 1e-12;  // the part of the squares that rounding leaves of a constant force
  if (!(run > least * aa) || !(recorded > least * bb)) return std::numeric_limits<double>::quiet_NaN();
  return (ab - a.dot(b) / ticks) / std::sqrt(run * recorded);
}

std::vector<Moments> lagged_moments(const std::vector<ForcePair>& ticks, double tick_seconds,
                                    std::ptrdiff_t most) {
  constexpr std::ptrdiff_t most_stretches = 64;
  const auto length = std::bit_ceil(static_cast<std::size_t>(8 * most + 64));
  const std::ptrdiff_t stretch =
      static_cast<std::ptrdiff_t>(length) - 2 * most;  // so that no sum wraps around
  const auto tick_of = [&](const ForcePair& tick) {
    return static_cast<std::ptrdiff_t>(std::llround((tick.time - ticks.front().time) / tick_seconds));
  };
  const std::ptrdiff_t stretches = ticks.empty() ? 0 : tick_of(ticks.back()) / stretch + 1;
  LaggedSums sums_of_all(length, most);
  const std::ptrdiff_t chosen = std::min(stretches, most_stretches);
  for (std::ptrdiff_t k = 0; k < chosen; ++k) {
    const std::ptrdiff_t begin = k * stretches / chosen * stretch, from = begin - most;
    const auto first =
        std::lower_bound(ticks.begin(), ticks.end(), from,
                         [&](const ForcePair& tick, std::ptrdiff_t at) { return tick_of(tick) < at; });
    Channels run, recorded;
    for (std::size_t c = 0; c < run.size(); ++c) {
      run[c].assign(length, 0.0);
      recorded[c].assign(length, 0.0);
    }
    bool any = false;
    for (auto tick = first; tick != ticks.end(); ++tick) {
      const std::ptrdiff_t at = tick_of(*tick);
      if (at >= from + static_cast<std::ptrdiff_t>(length)) break;
      put(run, static_cast<std::size_t>(at - from), tick->run);
      if (at < begin || at >= begin + stretch || std::isnan(tick->recorded.x())) continue;
      put(recorded, static_cast<std::size_t>(at - begin), tick->recorded);
      any = true;
    }
    if (any) sums_of_all.add(run, recorded);
  }
  return sums_of_all.moments();
}

Moments moments_at(const std::vector<ForcePair>& ticks, double tick_seconds, std::ptrdiff_t lag) {
  Moments sums;
  const auto shift = static_cast<double>(lag);
  auto later = ticks.begin();
  for (const ForcePair& then : ticks) {
    const auto apart = [&] { return (later->time - then.time) / tick_seconds - shift; };
    while (later != ticks.end() && apart() <= -0.5) ++later;
    if (later == ticks.end()) break;
    if (apart() < 0.5 && !std::isnan(then.recorded.x())) sums.add(later->run, then.recorded);
  }
  return sums;
}

}  // namespace sandstroke
