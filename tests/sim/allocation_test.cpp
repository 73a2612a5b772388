// The tick loop allocates nothing once the tiles under a stroke exist: every operator new of this program is
// (Not under sanitizers, which bring their own.)
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
// counted.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>

#include "sim/simulation.h"

namespace {
std::atomic<std::int64_t> allocations = 0;
}

// The C library's own, under which operator new and every other allocator get their memory.
extern "C" {
void* __libc_malloc(std::size_t);
void* __libc_calloc(std::size_t, std::size_t);
void* __libc_realloc(void*, std::size_t);
void* __libc_memalign(std::size_t, std::size_t);

void* malloc(std::size_t size) { return ++allocations, __libc_malloc(size); }
void* calloc(std::size_t count, std::size_t size) { return ++allocations, __libc_calloc(count, size); }
void* realloc(void* memory, std::size_t size) { return ++allocations, __libc_realloc(memory, size); }
void* memalign(std::size_t alignment, std::size_t size) {
  return ++allocations, __libc_memalign(alignment, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) { return memalign(alignment, size); }
int posix_memalign(void** memory, std::size_t alignment, std::size_t size) {
  *memory = memalign(alignment, size);
  return *memory ? 0 : 12;  // ENOMEM
}
}

namespace sandstroke {
namespace {

/// Counts what is allocated from one tick to another.
struct AllocationsBetween : SimulationObserver {
  std::int64_t from, to, tick = 0, before = 0, between = -1;
  AllocationsBetween(std::int64_t first, std::int64_t last) : from(first), to(last) {}
  void on_tick(const TickRecord&) override {
    if (tick == from) before = allocations;
    if (tick == to) between = allocations - before;
    ++tick;
  }
};

TEST(TickLoop, AllocatesNothingOnceItsTilesExist) {
  for (const auto& [law, method] : {std::pair(RelaxationLaw::paper, RelaxationMethod::passes),
                                    std::pair(RelaxationLaw::isotropic, RelaxationMethod::passes),
                                    std::pair(RelaxationLaw::isotropic, RelaxationMethod::rkl)}) {
    Scene scene;
    scene.bed.width = scene.bed.depth = 0.4;
    scene.bed.cols = scene.bed.rows = 200;
    scene.relaxation.law = law;
    scene.relaxation.method = method;
    scene.stroke.emplace();
    scene.stroke->file = "in memory";
    Stroke stroke;  // to and fro across tile borders, deeper each time
    stroke.gap_threshold = 1e9;
    for (int i = 0; i <= 12; ++i) {
      stroke.time.push_back(0.5 * i);
      stroke.position.emplace_back(i % 2 ? 0.05 : -0.05, 0.01, -0.001 - 2e-4 * i);
    }
    const BedSettings& bed = scene.bed;
    Simulation simulation(scene, make_surface(bed.surface, bed.rows, bed.cols, bed.cell_size()), stroke);
    AllocationsBetween observer(4000, 6000);
    const RunResult result = simulation.run(observer);
    EXPECT_GT(result.contact_ticks, 5000);
    EXPECT_EQ(observer.between, 0);
    EXPECT_GT(allocations, 0);  // they are counted
  }
}

}  // namespace
}  // namespace sandstroke

#endif
