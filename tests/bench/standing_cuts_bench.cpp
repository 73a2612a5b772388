// Looks at the cuts of a castle in 256 x 256 cells of 1 mm: a moat, crenellated walls, four round towers and
// a keep, turned by 20 degrees, so that hardly a face lies along the cells. At 150 Pa 3,320 toes could fail,
// and none does.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>

#include "core/angle.h"
#include "sand/standing_cuts.h"

namespace sandstroke {
namespace {

HeightField castle() {
  constexpr int side = 256;
  constexpr double cell = 0.001;  // m
  const double cosine = std::cos(to_radians(20.0)), sine = std::sin(to_radians(20.0));
  HeightGrid heights(side, side);
  for (int row = 0; row < side; ++row)
    for (int col = 0; col < side; ++col) {
      const double east = (col + 0.5 - 0.5 * side) * cell, north = (row + 0.5 - 0.5 * side) * cell;
      const double x = east * cosine + north * sine, y = north * cosine - east * sine;
      const double from_middle = std::max(std::abs(x), std::abs(y)),
                   along_wall = std::abs(x) > std::abs(y) ? y : x;
      double height = 0.03;
      if (from_middle > 0.082 && from_middle < 0.1) height = 0.01;
      if (from_middle > 0.05 && from_middle < 0.062)
        height = 0.06 + (static_cast<int>(std::floor(along_wall / 0.006 + 100.0)) % 2 ? 0.006 : 0.0);
      if (from_middle < 0.022) height = 0.095;
      if (std::hypot(std::abs(x) - 0.056, std::abs(y) - 0.056) < 0.016) height = 0.08;
      heights(row, col) = height;
    }
  return HeightField(heights, cell);
}

void LookAtCastle(benchmark::State& state) {
  constexpr double weight = 1600.0 * 9.81;  // N/m^3
  const Cohesion cohesion{static_cast<double>(state.range(0)) / weight};
  const CohesionFactor factor(SlipSurface::plane, 33.0);
  HeightField bed = castle();
  StandingCuts::Look look;
  for (auto _ : state) {
    state.PauseTiming();
    StandingCuts cuts(bed, factor);
    state.ResumeTiming();
    look = cuts.look(bed, cohesion);
    benchmark::DoNotOptimize(look);
  }
  if (look.failed > 0) state.SkipWithError("the castle does not stand");
  state.counters["toes"] = static_cast<double>(look.toes);
}
BENCHMARK(LookAtCastle)->ArgName("Pa")->Arg(150)->Arg(600)->Unit(benchmark::kMillisecond)->UseRealTime();

void LookAgain(benchmark::State& state) {
  HeightField bed = castle();
  StandingCuts cuts(bed, CohesionFactor(SlipSurface::plane, 33.0));
  const Cohesion cohesion{150.0 / (1600.0 * 9.81)};
  cuts.look(bed, cohesion);
  for (auto _ : state) benchmark::DoNotOptimize(cuts.look(bed, cohesion));
}
BENCHMARK(LookAgain)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace sandstroke
