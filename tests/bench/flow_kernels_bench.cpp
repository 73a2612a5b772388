// Cost of one 64 x 64 tile in a pass, part by part, on every instruction set of this machine.
#include "sand/flow_kernels.h"

#include <benchmark/benchmark.h>
#include <hwy/targets.h>

#include "bench/moving_sand.h"
#include "sand/active_sand.h"
#include "sand/slope_kernels.h"

namespace sandstroke {
namespace {

constexpr int tile_side = BedGeometry::tile_side;

/// Within it, the kernels use one instruction set.
class OnlyTarget {
 public:
  explicit OnlyTarget(std::int64_t target) {
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
  }
  ~OnlyTarget() {
    hwy::SetSupportedTargetsForTest(0);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
  }
};

/// The middle tile of 3 x 3, loaded.
struct Tile {
  TalusLaw law;
  HeightField bed;
  int slot = bed.slot_of(bed.tile_index(1, 1));
  CellFlags cells;
  RowSpan rows;
  TilePatch patch;
  FlowScratch scratch;
  TileFlow flow;

  Tile(RelaxationLaw relaxation_law, SandState state, const CellFlags& active = square_of_cells(0, tile_side))
      : law(talus_law(relaxation_settings(relaxation_law), 1.0)),
        bed(noisy_plane(3 * tile_side, 3 * tile_side, state)),
        cells(active),
        rows(row_span(active)) {
    load();
  }
  void load() {
    const RowSpan seen = {rows.begin - TilePatch::rim, rows.end + TilePatch::rim};
    patch.begin(slot);
    patch.load_rows(bed, seen);
    patch.load_rim(bed, seen, true, true, [](int) { return nullptr; });
  }
  void flow_once() { compute_flow(law, patch, cells, rows, {}, scratch, flow); }
};

void flow_bench(benchmark::State& state, std::int64_t target, RelaxationLaw law, SandState sand) {
  const OnlyTarget only(target);
  Tile tile(law, sand);
  const CellClock clock;
  for (auto _ : state) {
    tile.flow_once();
    benchmark::ClobberMemory();
  }
  if (count(tile.flow.moved) != (sand == SandState::moving ? tile_side * tile_side : 0))
    state.SkipWithError("the sand is not in the state it should be in");
  clock.report(state, count(tile.cells));
}

void apply_bench(benchmark::State& state, std::int64_t target) {
  const OnlyTarget only(target);
  Tile tile(RelaxationLaw::paper, SandState::moving);
  tile.flow_once();
  CellFlags changed;
  const CellClock clock;
  for (auto _ : state) {
    apply_flow(tile.flow, nullptr, tile.patch, changed);
    benchmark::ClobberMemory();
  }
  clock.report(state, count(tile.cells));
}

void residuals_bench(benchmark::State& state, std::int64_t target, RelaxationLaw law) {
  const OnlyTarget only(target);
  Tile tile(law, SandState::moving);
  std::array<double, tile_side * tile_side / 8> steepest;
  const CellClock clock;
  for (auto _ : state) {
    compute_residuals(tile.law, tile.patch, nullptr, tile.cells, steepest.data());
    benchmark::ClobberMemory();
  }
  clock.report(state, count(tile.cells));
}

/// Loading does not depend on the instruction set: plain copies. cells: a square of the tile's middle.
void load_bench(benchmark::State& state) {
  const int half = static_cast<int>(state.range(0)) / 2;
  Tile tile(RelaxationLaw::paper, SandState::moving,
            square_of_cells(tile_side / 2 - half, tile_side / 2 + half));
  const CellClock clock;
  for (auto _ : state) {
    tile.load();
    benchmark::ClobberMemory();
  }
  clock.report(state, count(tile.cells));
}
BENCHMARK(load_bench)->Name("patch_load/cells")->Arg(16)->Arg(64);

/// A small square of active cells, as under a tool: load, flow and apply.
void small_patch_bench(benchmark::State& state, RelaxationLaw law) {
  const int half = static_cast<int>(state.range(0)) / 2;
  Tile tile(law, SandState::moving, square_of_cells(tile_side / 2 - half, tile_side / 2 + half));
  CellFlags changed;
  const CellClock clock;
  for (auto _ : state) {
    tile.load();
    tile.flow_once();
    apply_flow(tile.flow, nullptr, tile.patch, changed);
    benchmark::ClobberMemory();
  }
  clock.report(state, count(tile.cells));
}

/// The plain reference, whole field, for comparison: `passes` of them and the look that precedes each.
void reference_bench(benchmark::State& state, RelaxationLaw law, SandState sand) {
  constexpr int passes = 4;
  const HeightField start = noisy_plane(3 * tile_side, 3 * tile_side, sand);
  RelaxationSettings settings = relaxation_settings(law);
  settings.max_passes = passes;
  const auto relaxer = make_plain_relaxer(settings, 1.0);
  const CellClock clock;
  for (auto _ : state) {
    HeightField bed = start;
    benchmark::DoNotOptimize(relaxer->relax(bed));
  }
  const int looks = sand == SandState::moving ? passes + 1 : 1;
  clock.report(state, std::int64_t{9} * tile_side * tile_side * looks);
}

const bool flow_kernels_registered = [] {
  constexpr RelaxationLaw laws[] = {RelaxationLaw::paper, RelaxationLaw::isotropic};
  constexpr std::pair<SandState, const char*> states[] = {{SandState::at_rest, "rest"},
                                                          {SandState::moving, "moving"}};
  const auto add = [](const std::string& name, auto body) {
    return benchmark::RegisterBenchmark(name.c_str(), body);
  };
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    const std::string set = hwy::TargetName(target);
    for (const RelaxationLaw law : laws) {
      for (const auto& [sand, sand_name] : states)
        add("compute_flow/" + name_of(law) + "/" + sand_name + "/" + set,
            [=, sand = sand](benchmark::State& state) { flow_bench(state, target, law, sand); });
      add("compute_residuals/" + name_of(law) + "/" + set,
          [=](benchmark::State& state) { residuals_bench(state, target, law); });
    }
    add("apply_flow/" + set, [=](benchmark::State& state) { apply_bench(state, target); });
  }
  for (const RelaxationLaw law : laws) {
    for (const auto& [sand, sand_name] : states)
      add("reference/" + name_of(law) + "/" + sand_name,
          [=, sand = sand](benchmark::State& state) { reference_bench(state, law, sand); });
    add("small_patch/" + name_of(law) + "/cells",
        [=](benchmark::State& state) { small_patch_bench(state, law); })
        ->Arg(8)
        ->Arg(16)
        ->Arg(32)
        ->Arg(64);
  }
  return true;
}();

}  // namespace
}  // namespace sandstroke
