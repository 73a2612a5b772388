// The tick loop allocates nothing once the tiles under a stroke exist.
#include <gtest/gtest.h>

#include "allocations.h"
#include "sim/simulation.h"

namespace sandstroke {
namespace {

/// Counts allocations from one tick to another.
struct AllocationsBetween : SimulationObserver {
  std::int64_t from, to, tick = 0, before = 0, between = -1;
  AllocationsBetween(std::int64_t first, std::int64_t last) : from(first), to(last) {}
  void on_tick(const TickRecord&) override {
    if (tick == from) before = allocations();
    if (tick == to) between = allocations() - before;
    ++tick;
  }
};

TEST(TickLoop, AllocatesNothingOnceItsTilesExist) {
  if (!allocations_are_counted()) GTEST_SKIP() << "sanitizers bring their own allocator";
  Scene paper, isotropic, rkl, accurate;
  isotropic.relaxation.law = rkl.relaxation.law = RelaxationLaw::isotropic;
  rkl.relaxation.method = RelaxationMethod::rkl;
  accurate.preset = ModelPreset::accurate;
  apply_model_preset(accurate);
  for (Scene scene : {paper, isotropic, rkl, accurate}) {
    scene.bed.width = scene.bed.depth = 0.4;
    scene.bed.cols = scene.bed.rows = 200;
    scene.stroke.emplace();
    scene.stroke->file = "in memory";
    Stroke stroke;  // to and fro across tile borders, deeper each time
    stroke.gap_threshold = 1e9;
    for (int i = 0; i <= 12; ++i) {
      stroke.time.push_back(0.5 * i);
      stroke.position.emplace_back(i % 2 ? 0.05 : -0.05, 0.01, -0.001 - 2e-4 * i);
    }
    const BedSettings& bed = scene.bed;
    Simulation simulation(scene, starting_bed(bed), stroke);
    AllocationsBetween observer(4000, 6000);
    const RunResult result = simulation.run({&observer});
    EXPECT_GT(result.contact_ticks, 5000);
    EXPECT_EQ(observer.between, 0);
    EXPECT_GT(allocations(), 0);
  }
}

}  // namespace
}  // namespace sandstroke
