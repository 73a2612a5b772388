#include "record/bed_replica.h"

#include <gtest/gtest.h>

#include <random>

#include "sand/relaxation.h"

namespace sandstroke {
namespace {

HeightField bumpy_bed(int rows, int cols) {
  HeightGrid heights(rows, cols);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> height(0.0, 0.01);
  for (double& h : heights.reshaped()) h = height(random);
  return {heights, 0.01};
}

TEST(BedReplica, TwoThatChangeTheSameCellsMeetWhateverTheOrder) {
  // Both change overlapping cells many times, and hear of each other late.
  const HeightField start = bumpy_bed(100, 150);
  BedReplica one(start), other(start);
  std::mt19937 random(1);
  std::uniform_int_distribution<int> row(0, 99), col(0, 149);
  std::uniform_real_distribution<double> change(-0.01, 0.01);
  std::vector<SandChange> from_one, from_other;
  for (int round = 0; round < 50; ++round) {
    for (int i = 0; i < 40; ++i) {
      const int r = row(random), c = col(random);
      one.bed().set(r, c, one.bed()(r, c) + change(random));
      const int r2 = row(random), c2 = col(random);
      other.bed().set(r2, c2, other.bed()(r2, c2) + change(random));
    }
    one.tell_disturbed([&](const SandChange& told) { from_one.push_back(told); });
    other.tell_changed([&](const SandChange& told) { from_other.push_back(told); });
    if (round % 7 != 6 && round != 49) continue;
    for (const SandChange& told : from_one) other.take_displaced(told);
    for (const SandChange& told : from_other) one.take_relaxed(told);
    from_one.clear();
    from_other.clear();
    EXPECT_LT((one.bed().grid() - other.bed().grid()).abs().maxCoeff(), 1e-15);
  }
  // Nothing is left to be told: what was taken is not told back.
  const auto never = [](const SandChange&) { FAIL(); };
  one.tell_disturbed(never);
  one.tell_changed(never);
  other.tell_changed(never);
}

TEST(BedReplica, ARelaxedBedIsToldWholeAndLosesNoSand) {
  HeightField steep(130, 130, 0.01);
  for (int i = 60; i < 70; ++i)
    for (int j = 60; j < 70; ++j) steep.set(i, j, 0.2);
  BedReplica servo(steep), relaxing(steep);
  RelaxationSettings settings;
  const auto relaxer = make_relaxer(settings, 0.01);
  ASSERT_GT(relaxer->relax(relaxing.bed()).passes, 0);
  std::size_t told = 0;
  relaxing.tell_changed([&](const SandChange& change) {
    servo.take_relaxed(change);
    ++told;
  });
  EXPECT_GT(told, 100u);
  EXPECT_LT((servo.bed().grid() - relaxing.bed().grid()).abs().maxCoeff(), 1e-16);
  EXPECT_NEAR(servo.bed().volume() / steep.volume(), 1.0, 1e-14);
}

TEST(BedReplica, RelaxesAsTheBedItselfWould) {
  HeightField plain = bumpy_bed(130, 70);
  for (int i = 0; i < 5; ++i) plain.set(64, 30 + i, 0.3);
  BedReplica replica(plain);
  const RelaxationSettings settings;
  make_relaxer(settings, 0.01)->relax(plain);
  make_relaxer(settings, 0.01)->relax(replica.bed());
  EXPECT_EQ((plain.grid() != replica.bed().grid()).count(), 0);
}

}  // namespace
}  // namespace sandstroke
