#pragma once

#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdint>
#include <ctime>
#include <random>
#include <string>

#include "rules/talus.h"
#include "sand/relaxation.h"

namespace sandstroke {

enum class SandState { at_rest, moving };

inline RelaxationSettings relaxation_settings(RelaxationLaw law) {
  RelaxationSettings settings;
  settings.law = law;
  return settings;
}

inline std::string name_of(RelaxationLaw law) { return law == RelaxationLaw::paper ? "paper" : "isotropic"; }

/// A bed of cells of 1 m without symmetry: a plane with a little noise, steep enough that every cell that has
/// lower neighbours moves, or so gentle that none does. All tiles exist.
inline HeightField noisy_plane(int rows, int cols, SandState state) {
  const double slope = (state == SandState::moving ? 1.5 : 0.5) * std::tan(std::acos(-1.0) / 6.0);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> noise(-0.02, 0.02);
  HeightGrid heights(rows, cols);
  for (int row = 0; row < rows; ++row)
    for (int col = 0; col < cols; ++col)
      heights(row, col) = slope * (0.9 * col + 0.436 * row) + noise(random);
  return HeightField(heights, 1.0);
}

/// Times a benchmark's loop from construction to report(), to say what a cell costs. (Rates of the library
/// print in seconds.) On one thread by its CPU time, which other programs disturb less.
class CellClock {
 public:
  explicit CellClock(int threads = 1) : clock_(threads == 1 ? CLOCK_THREAD_CPUTIME_ID : CLOCK_MONOTONIC) {}
  void report(benchmark::State& state, std::int64_t cells_per_iteration) const {
    state.counters["ns_per_cell"] = (now() - begin_) / (static_cast<double>(state.iterations()) *
                                                        static_cast<double>(cells_per_iteration));
  }

 private:
  double now() const {
    timespec time;
    clock_gettime(clock_, &time);
    return 1e9 * static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_nsec);
  }
  clockid_t clock_;
  double begin_ = now();  // ns
};

/// The cells [begin, end) x [begin, end) of a tile.
inline CellFlags square_of_cells(int begin, int end) {
  CellFlags flags{};
  for (int row = begin; row < end; ++row)
    flags[row] = (end - begin == 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << (end - begin)) - 1) << begin;
  return flags;
}

}  // namespace sandstroke
