#include "record/live_relaxer.h"

#include <gtest/gtest.h>

#include <atomic>
#include <new>

namespace sandstroke {
namespace {

TEST(LiveRelaxer, TakesDisplacedSandBetweenRareRelaxationsAndEndsWhenAsked) {
  for (const double rate : {1e-4, 1e-300, 0.0}) {
    RelaxationSettings settings;
    settings.rate = rate;
    SandRing displaced(8), relaxed(8);
    PoseRing poses(8);
    LiveRelaxer live_relaxer(HeightField(10, 10, 0.01), {}, settings, displaced, poses, relaxed);
    poses.push({});  // from the first pose on
    live_relaxer.start();
    for (int i = 0; i < 3; ++i) {
      displaced.push({5, i, -1e-6});
      while (displaced.size() > 0) std::this_thread::yield();
    }
    live_relaxer.stop();
    for (int i = 0; i < 3; ++i) EXPECT_EQ(live_relaxer.bed()(5, i), -1e-6);
    EXPECT_EQ(live_relaxer.report().relaxations, rate > 0.0 ? 1 : 0);
  }
}

const ToolSettings solid_sphere{.radius = 0.03, .profile = ToolProfile::sphere, .solid = true};
/// Relaxation each time a tool has gone a third of its radius: of 30 mm, a cell.
RelaxationSettings by_way() {
  RelaxationSettings settings;
  settings.rate = 0.0;
  settings.way = 1.0 / 3.0;
  return settings;
}

/// A bed with a heap where a solid tool stands, and relaxes as often as the tool goes its way.
TEST(LiveRelaxer, RelaxesNothingUnderASolidToolUntilItHasGone) {
  SandRing displaced(64), relaxed(64);
  PoseRing poses(8);
  LiveRelaxer live_relaxer(HeightField(41, 41, 0.01), solid_sphere, by_way(), displaced, poses, relaxed);
  displaced.push({20, 20, 0.05});
  poses.push({{0.0, 0.0, -0.01}, true});
  live_relaxer.turn();
  EXPECT_EQ(live_relaxer.bed()(20, 20), 0.05);
  EXPECT_EQ(relaxed.size(), 0u);
  poses.push({{0.0, 0.0, 0.1}, false});
  live_relaxer.turn();
  EXPECT_LT(live_relaxer.bed()(20, 20), 0.05);
  EXPECT_GT(relaxed.size(), 0u);
}

/// Only counts.
class CountingRelaxer : public Relaxer {
 public:
  explicit CountingRelaxer(std::atomic<int>& count) : count_(count) {}
  RelaxationOutcome relax(HeightField&, const PassWatcher&) override {
    ++count_;
    RelaxationOutcome outcome;
    outcome.converged = true;
    return outcome;
  }

 private:
  std::atomic<int>& count_;
};

TEST(LiveRelaxer, RelaxesInItsThreadAsOftenAsTheToolHasGoneItsWay) {
  SandRing displaced(64), relaxed(64);
  PoseRing poses(8);
  std::atomic<int> relaxations = 0;
  LiveRelaxer live_relaxer(HeightField(41, 41, 0.01), solid_sphere, by_way(), displaced, poses, relaxed,
                           std::make_unique<CountingRelaxer>(relaxations));
  const auto go_to = [&](double x, bool contact) {
    poses.push({{x, 0.0, contact ? -0.01 : 0.1}, contact});
    while (poses.size() > 0) std::this_thread::yield();
  };
  poses.push({{0.0, 0.0, -0.01}, true});  // it touches down
  live_relaxer.start();
  while (relaxations < 1) std::this_thread::yield();
  for (int cells = 1; cells <= 3; ++cells) {
    for (int i = 1; i < 10; ++i) go_to(0.01 * (cells - 1) + 0.001 * i, true);  // less than a cell: nothing
    EXPECT_EQ(relaxations, cells);
    go_to((0.01 + 1e-12) * cells, true);
    while (relaxations < cells + 1) std::this_thread::yield();
  }
  go_to(0.03, false);  // it leaves
  while (relaxations < 5) std::this_thread::yield();
  live_relaxer.stop();
  EXPECT_EQ(relaxations, 5);
}

/// A tool that stays where sand relaxed last: what it pushes out from then on waits for it to go on.
TEST(LiveRelaxer, ShowsSandAtRestWhileItsOwnWaitsForTheTool) {
  SandRing displaced(64), relaxed(64);
  PoseRing poses(8);
  std::atomic<int> looks = 0;
  std::atomic<double> highest = 0.0, volume = 0.0;
  LiveRelaxer live_relaxer(HeightField(41, 41, 0.01), solid_sphere, by_way(), displaced, poses, relaxed);
  const HeightField* shown = nullptr;
  live_relaxer.show_to([&](const HeightField& bed) {
    if (shown) {
      EXPECT_EQ(&bed, shown);
    }
    shown = &bed;
    highest = bed.highest();
    volume = bed.volume();
    ++looks;
  });
  poses.push({{0.0, 0.0, -0.01}, true});
  live_relaxer.start();
  while (looks < 1) std::this_thread::yield();
  displaced.push({20, 30, 0.05});
  while (volume == 0.0) std::this_thread::yield();
  live_relaxer.stop();
  live_relaxer.show();  // as a recording ends
  const int pictures = looks;
  live_relaxer.show();
  poses.push({{1e-6, 0.0, -0.01}, true});  // the hand trembles
  live_relaxer.exchange();
  live_relaxer.show();
  EXPECT_EQ(looks, pictures) << "nothing has changed";
  EXPECT_EQ(live_relaxer.report().relaxations, 1);
  EXPECT_EQ(live_relaxer.bed()(20, 30), 0.05);
  EXPECT_EQ(relaxed.size(), 0u);
  EXPECT_LT(highest, 0.02);
  EXPECT_NEAR(volume, 0.05 * 1e-4, 1e-15);
}

/// A relaxer on a machine without memory left.
class FailingRelaxer : public Relaxer {
 public:
  RelaxationOutcome relax(HeightField&, const PassWatcher&) override { throw std::bad_alloc(); }
};

TEST(LiveRelaxer, EndsItsThreadAndNotTheProgramWhereItFails) {
  SandRing displaced(8), relaxed(8);
  PoseRing poses(8);
  LiveRelaxer live_relaxer(HeightField(10, 10, 0.01), {}, {}, displaced, poses, relaxed,
                           std::make_unique<FailingRelaxer>());
  displaced.push({5, 5, -1e-6});
  poses.push({});
  live_relaxer.start();
  while (displaced.size() > 0) std::this_thread::yield();  // in the first turn, which fails right after
  live_relaxer.stop();
  ASSERT_TRUE(live_relaxer.failure());
  EXPECT_THROW(std::rethrow_exception(live_relaxer.failure()), std::bad_alloc);
}

TEST(LiveRelaxer, TurnsAreAsShortAsTheSettingsSayAndTheirPassesAddUp) {
  for (const auto& [most, in_a_turn] : {std::pair<std::int64_t, std::int64_t>{7, 7}, {1'000'000, 50}}) {
    RelaxationSettings settings;
    settings.max_passes = most;
    SandRing displaced(8), relaxed(std::size_t{1} << 16);
    PoseRing poses(8);
    HeightField heap(61, 61, 0.01);
    for (int row = 25; row < 36; ++row)
      for (int col = 25; col < 36; ++col) heap.set(row, col, 0.3);
    LiveRelaxer live_relaxer(heap, {}, settings, displaced, poses, relaxed);
    for (int turn = 1; turn <= 3; ++turn) {
      live_relaxer.turn();
      EXPECT_EQ(live_relaxer.report().relaxations, turn);
      EXPECT_EQ(live_relaxer.report().passes, turn * in_a_turn);
      EXPECT_FALSE(live_relaxer.report().converged);
    }
  }
}

TEST(LiveRelaxer, RelaxesWhatWasDisplaced) {
  RelaxationSettings settings;
  SandRing displaced(8), relaxed(1024);
  PoseRing poses(8);
  LiveRelaxer live_relaxer(HeightField(41, 41, 0.01), {}, settings, displaced, poses, relaxed);
  live_relaxer.turn();
  EXPECT_EQ(relaxed.size(), 0u);
  displaced.push({20, 20, 0.05});
  live_relaxer.turn();
  EXPECT_LT(live_relaxer.bed()(20, 20), 0.05);
  EXPECT_GT(live_relaxer.bed()(20, 21), 0.0);
}

TEST(LiveRelaxer, SandThatAsksByWayAndHasFarToGoGoesOnWithoutTheToolsMoving) {
  SandRing displaced(8), relaxed(std::size_t{1} << 18);
  PoseRing poses(8);
  HeightField heap(61, 61, 0.01);
  for (int row = 25; row < 36; ++row)
    for (int col = 25; col < 36; ++col) heap.set(row, col, 0.3);
  poses.push({{0.2, 0.2, -0.01}, true});  // it touches down beside the heap, and rests
  LiveRelaxer live_relaxer(heap, {.radius = 0.01, .profile = ToolProfile::sphere}, by_way(), displaced, poses,
                           relaxed);
  live_relaxer.start();
  RelaxationSettings looser = by_way();  // changes add up to the live_relaxer's own heights but for rounding
  looser.tolerance *= 2.0;
  const auto rests = [&] {
    HeightField copy = heap;
    return make_relaxer(looser, 0.01)->relax(copy).passes == 0;
  };
  for (SandChange change; !rests();) {
    while (relaxed.pop(change))
      heap.set(change.row, change.col, heap(change.row, change.col) + change.change);
    std::this_thread::yield();
  }
  live_relaxer.stop();
  EXPECT_GT(live_relaxer.report().relaxations, 2);
}

}  // namespace
}  // namespace sandstroke
