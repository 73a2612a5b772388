// Whole passes over n active tiles on one thread and on two, and what it costs to wake sand.
#include "sand/active_sand.h"

#include <benchmark/benchmark.h>
#include <tbb/global_control.h>

#include <limits>

#include "bench/moving_sand.h"

namespace sandstroke {
namespace {

constexpr int side = BedGeometry::tile_side;
enum class Active { whole_tiles, patches };

/// A bed of n tiles, 2^k by 2^k or twice as wide, in which all cells move, and passes over it that do the
/// same work each time: what flows is below rounding.
class EndlessPasses {
 public:
  EndlessPasses(int tiles, RelaxationLaw law, Active active, std::int64_t worth_threads)
      : bed_(bed_of(tiles)),
        sand_(slow(law), 0.0, 1.0, Givers::all, {}, worth_threads),
        // A cell wakes those within two: 11 x 11 that change keep 15 x 15 active.
        changed_(active == Active::patches ? square_of_cells(26, 37) : square_of_cells(0, side)) {
    sand_.begin(bed_);
    pass();
  }
  void pass() {
    benchmark::DoNotOptimize(sand_.compute_flow(
        bed_, [](int, RelaxedTile&) { return FlowInStep{}; }, [](int) {}));
    sand_.advance(bed_, [this](int, RelaxedTile& tile) {
      apply_flow(tile.flow, nullptr, tile.patch, tile.changed);
      tile.changed = changed_;
    });
  }
  std::int64_t cells() const {
    std::int64_t cells = 0;
    for (const int slot : sand_.tiles()) cells += count(sand_.cells(slot));
    return cells;
  }

 private:
  static TalusLaw slow(RelaxationLaw law) {
    RelaxationSettings settings = relaxation_settings(law);
    settings.share = 1e-30;
    return talus_law(settings, 1.0);
  }
  static HeightField bed_of(int tiles) {
    int rows = 1;
    while (4 * rows * rows <= tiles) rows *= 2;
    return noisy_plane(rows * side, tiles / rows * side, SandState::moving);
  }

  HeightField bed_;
  ActiveSand sand_;
  CellFlags changed_;
};

void pass_bench(benchmark::State& state, RelaxationLaw law, Active active, int threads) {
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                  static_cast<std::size_t>(threads));
  EndlessPasses passes(static_cast<int>(state.range(0)), law, active,
                       threads > 1 ? 0 : std::numeric_limits<std::int64_t>::max());
  const CellClock clock(threads);
  for (auto _ : state) passes.pass();
  clock.report(state, passes.cells());
  state.counters["cells"] = static_cast<double>(passes.cells());
}

const bool registered = [] {
  for (const RelaxationLaw law : {RelaxationLaw::paper, RelaxationLaw::isotropic})
    for (const Active active : {Active::whole_tiles, Active::patches})
      for (const int threads : {1, 2})
        benchmark::RegisterBenchmark(
            ("pass/" + name_of(law) + (active == Active::patches ? "/patches" : "/whole") +
             "/threads:" + std::to_string(threads) + "/tiles")
                .c_str(),
            [=](benchmark::State& state) { pass_bench(state, law, active, threads); })
            ->Arg(1)
            ->Arg(2)
            ->Arg(4)
            ->Arg(8)
            ->Arg(16)
            ->Arg(64)
            ->Arg(256)
            ->UseRealTime()
            ->Unit(benchmark::kMicrosecond);
  return true;
}();

/// One cell of a bed at rest is set, to a height at which it rests, and the bed relaxed. range(0)^2 tiles
/// exist.
void wake_bench(benchmark::State& state) {
  const int tiles = static_cast<int>(state.range(0)), n = 4096;
  HeightField bed(n, n, 1.0);
  const auto relaxer = make_tile_relaxer(relaxation_settings(RelaxationLaw::paper), 1.0);
  for (int row = 0; row < tiles; ++row)
    for (int col = 0; col < tiles; ++col) bed.set(row * side + 20, col * side + 20, 0.0);
  relaxer->relax(bed);
  double height = 0.1;
  int tile = 0;
  for (auto _ : state) {
    bed.set(tile / tiles * side + 20, tile % tiles * side + 20, height);
    if (relaxer->relax(bed).passes) state.SkipWithError("the sand moved");
    if (++tile == tiles * tiles) {
      tile = 0;
      height = 0.1 - height;
    }
  }
}
BENCHMARK(wake_bench)->Name("wake/tiles")->Arg(1)->Arg(8)->Arg(32);

}  // namespace
}  // namespace sandstroke
