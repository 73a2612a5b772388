#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace sandstroke {

/// The forces of one tick.
struct ForcePair {
  double time;                    ///< s
  Eigen::Vector3d run, recorded;  ///< N; recorded: NaN if unknown

  template <class State>
  void visit_state(State& state) {
    state.value("time", time);
    state.value("run", run);
    state.value("recorded", recorded);
  }
};

/// Sums over ticks that have a run's force a and a recorded one b.
struct Moments {
  double ticks = 0.0, aa = 0.0, bb = 0.0, ab = 0.0;
  Eigen::Vector3d a = Eigen::Vector3d::Zero(), b = Eigen::Vector3d::Zero();

  void add(const Eigen::Vector3d& run, const Eigen::Vector3d& recorded);
  /// sum(a.b) / sqrt(sum(a.a) sum(b.b)) of the forces, each less its mean. NaN where one never changes.
  double correlation() const;
};

/// Moments that pair the recorded force with the run's force `lag` ticks later: for lags from -most to most,
/// in this order. Ticks that the trace leaves out have no pair. The Fourier transform gives all lags at once,
/// to 1e-13 of the largest sum. Of more ticks than 64 stretches (200 s at 1 kHz) evenly chosen stretches
/// count. ticks: by time, in whole multiples of tick_seconds [s].
std::vector<Moments> lagged_moments(const std::vector<ForcePair>& ticks, double tick_seconds,
                                    std::ptrdiff_t most);
/// The same for one lag and all ticks, exactly.
Moments moments_at(const std::vector<ForcePair>& ticks, double tick_seconds, std::ptrdiff_t lag);

}  // namespace sandstroke
