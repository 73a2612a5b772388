#include "sand/relaxation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "sand/active_sand.h"
#include "sand/all_laws.h"
#include "sand/initial_surface.h"
#include "sand/symmetry.h"
#include "sanitized.h"

namespace sandstroke {
namespace {

constexpr double tan30 = 0.57735026918962576451;

RelaxationSettings settings(RelaxationLaw law) {
  RelaxationSettings s;
  s.law = law;
  return s;
}

HeightField random_bed(int rows, int cols, double dx, double amplitude, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> height(-amplitude, amplitude);
  HeightField bed(rows, cols, dx);
  for (int row = 0; row < rows; ++row)
    for (int col = 0; col < cols; ++col) bed.set(row, col, height(random));
  return bed;
}

class AllLaws : public testing::TestWithParam<RelaxationLaw> {};
INSTANTIATE_TEST_SUITE_P(Laws, AllLaws, testing::ValuesIn(all_laws), law_name);

TEST(PaperLaw, OnePassOfOneHighCellIsAsWritten) {
  HeightField bed(3, 3, 1.0);
  bed.set(1, 1, 2.0);
  RelaxationSettings s = settings(RelaxationLaw::paper);
  s.max_passes = 1;
  const auto outcome = make_relaxer(s, 1.0)->relax(bed);
  // All 8 neighbours lie 2 lower; the steepest excess is towards the axis ones: dm = 1/2 (2 - tan 30), in
  // equal parts.
  const double given = 0.5 * (2.0 - tan30);
  EXPECT_EQ(outcome.passes, 1);
  EXPECT_FALSE(outcome.converged);
  EXPECT_NEAR(bed(1, 1), 2.0 - given, 1e-15);
  EXPECT_NEAR(bed(0, 0), given / 8.0, 1e-15);
  EXPECT_NEAR(bed(0, 1), given / 8.0, 1e-15);
  EXPECT_NEAR(outcome.moved_volume, given, 1e-15);
}

TEST(PaperLaw, ACellGivesInProportionToTheDrop) {
  HeightField bed(1, 3, 1.0);
  bed.set(0, 1, 2.0);
  bed.set(0, 2, 1.0);  // drops: 2 to the left, 1 to the right, both over tan 30
  RelaxationSettings s = settings(RelaxationLaw::paper);
  s.max_passes = 1;
  make_relaxer(s, 1.0)->relax(bed);
  const double given = 0.5 * (2.0 - tan30);
  EXPECT_NEAR(bed(0, 0), given * 2.0 / 3.0, 1e-15);
  EXPECT_NEAR(bed(0, 2), 1.0 + given / 3.0, 1e-15);
}

TEST(IsotropicLaw, OnePassOfOneHighCellIsAsWritten) {
  HeightField bed(3, 3, 1.0);
  bed.set(1, 1, 2.0);
  RelaxationSettings s = settings(RelaxationLaw::isotropic);
  s.max_passes = 1;
  make_relaxer(s, 1.0)->relax(bed);
  // gx = gy = 2, |g| = 2 sqrt 2: each axis neighbour gets 1/4 (1 - tan 30 / |g|) 2; the corners nothing.
  const double gain = 0.25 * (1.0 - tan30 / (2.0 * std::sqrt(2.0))) * 2.0;
  EXPECT_NEAR(bed(0, 1), gain, 1e-15);
  EXPECT_NEAR(bed(1, 2), gain, 1e-15);
  EXPECT_EQ(bed(0, 0), 0.0);
  EXPECT_NEAR(bed(1, 1), 2.0 - 4.0 * gain, 1e-15);
}

TEST_P(AllLaws, TheShareAskedForIsWhatFlows) {
  // One pass is c times a flow that does not depend on c.
  for (const double share : {0.05, 0.2}) {
    RelaxationSettings own = settings(GetParam()), asked = own;
    own.max_passes = asked.max_passes = 1;
    asked.share = share;
    HeightField start = random_bed(10, 10, 1.0, 5.0, 8), by_own = start, by_asked = start;
    make_relaxer(own, 1.0)->relax(by_own);
    make_relaxer(asked, 1.0)->relax(by_asked);
    const double ratio = share / (GetParam() == RelaxationLaw::paper ? 0.5 : 0.25);
    EXPECT_LT((by_asked.grid() - start.grid() - ratio * (by_own.grid() - start.grid())).abs().maxCoeff(),
              1e-14);
    EXPECT_EQ(flow_share(asked), share);
  }
}

TEST_P(AllLaws, IsTheSameAtAnyLevelOnBedsOfAnyWidth) {
  for (const int cols : {1, 7, 9, 15, 17}) {
    HeightField ground = random_bed(13, cols, 1.0, 5.0, 9);
    const HeightGrid start = ground.grid();
    const RelaxationOutcome expected = make_relaxer(settings(GetParam()), 1.0)->relax(ground);
    for (const double level : {50.0, -50.0}) {
      HeightField bed(HeightGrid(start + level), 1.0);
      const RelaxationOutcome outcome = make_relaxer(settings(GetParam()), 1.0)->relax(bed);
      EXPECT_EQ(outcome.passes, expected.passes);
      EXPECT_NEAR(outcome.residual, expected.residual, 1e-9);
      EXPECT_NEAR(outcome.moved_volume, expected.moved_volume, 1e-9 * expected.moved_volume);
      EXPECT_LT((bed.grid() - level - ground.grid()).abs().maxCoeff(), 1e-9);
    }
  }
}

TEST_P(AllLaws, ATileThatChangesTellsAndNoOther) {
  for (const RelaxationMethod method : {RelaxationMethod::passes, RelaxationMethod::rkl}) {
    RelaxationSettings s = settings(GetParam());
    s.method = method;
    HeightField bed(200, 200, 1.0);
    const auto relaxer = make_relaxer(s, 1.0);
    for (const int row : {30, 60, 100}) {
      bed.set(row, 62, 20.0);
      const HeightField before = bed;
      EXPECT_GT(relaxer->relax(bed).passes, 0);
      const auto changed = (bed.grid() != before.grid()).eval();
      for (int tile = 0; tile < bed.tile_count(); ++tile) {
        const CellRange cells = bed.tile_cells(tile);
        const bool any = changed.block(cells.row_begin, cells.col_begin, cells.rows(), cells.cols()).any();
        if (before.slot_of(tile) >= 0) {
          EXPECT_EQ(bed.tile_revision(tile) != before.tile_revision(tile), any) << row << ", tile " << tile;
        } else if (any) {
          EXPECT_GT(bed.tile_revision(tile), HeightField::new_tile_revision) << row << ", tile " << tile;
        }
      }
    }
  }
}

TEST_P(AllLaws, TheBedIsAsItWasUntilARelaxationEndsButForWhoAsks) {
  for (const RelaxationMethod method : {RelaxationMethod::passes, RelaxationMethod::rkl}) {
    RelaxationSettings s = settings(GetParam());
    s.method = method;
    const HeightField start = random_bed(150, 150, 1.0, 8.0, 1);
    const auto relax = [&](std::int64_t passes, const PassWatcher& watcher = {}) {
      RelaxationSettings some = s;
      some.max_passes = passes;
      HeightField bed = start;
      make_relaxer(some, 1.0)->relax(bed, watcher);
      return bed;
    };
    HeightField bed = start;
    std::int64_t told = 0;
    make_relaxer(s, 1.0)->relax(bed, [&](std::int64_t passes, const BedNow& bed_now) {
      EXPECT_EQ(passes, ++told);
      if (passes == 2) {
        EXPECT_TRUE((bed.grid() == start.grid()).all());
        EXPECT_TRUE((bed_now().grid() == relax(2).grid()).all());
        EXPECT_TRUE((bed.grid() == relax(2).grid()).all());
      }
      if (passes == 5) {
        EXPECT_TRUE((bed_now().grid() == relax(5).grid()).all());
      }
    });
    EXPECT_GT(told, 5);
    EXPECT_TRUE((bed.grid() == relax(s.max_passes).grid()).all());  // looking changes nothing
  }
}

TEST_P(AllLaws, TilesGiveTheBitsOfTheReference) {
  struct Case {
    int rows, cols;
    double amplitude, talus;
  };
  unsigned seed = 1;
  for (const Case& c : {Case{1, 1, 1.0, 30},
                        {1, 200, 3.0, 30},
                        {200, 1, 3.0, 20},
                        {64, 64, 2.0, 45},
                        {65, 130, 1.5, 30},
                        {63, 129, 0.4, 10},
                        {70, 128, 3.0, 30},  // whole tiles along one side, so that walls are at their borders
                        {128, 66, 3.0, 30},
                        {128, 70, 20.0, 60}}) {
    RelaxationSettings s = settings(GetParam());
    s.talus_angle = c.talus;
    HeightField tiles = random_bed(c.rows, c.cols, 1.0, c.amplitude, ++seed);
    HeightField plain = tiles;
    const auto by_tiles = make_relaxer(s, 1.0);
    const auto by_reference = make_plain_relaxer(s, 1.0);
    // Again after a disturbance at a tile corner: sleeping tiles must wake.
    for (int round = 0; round < 3; ++round) {
      const auto a = by_tiles->relax(tiles), b = by_reference->relax(plain);
      EXPECT_TRUE((tiles.grid() == plain.grid()).all());
      EXPECT_EQ(a.passes, b.passes);
      EXPECT_EQ(a.residual, b.residual);
      EXPECT_EQ(a.converged, b.converged);
      EXPECT_NEAR(a.moved_volume, b.moved_volume, 1e-12 * (1.0 + b.moved_volume));
      const int row = std::min(63 + round, c.rows - 1), col = std::min(64 - round, c.cols - 1);
      tiles.set(row, col, 15.0);
      plain.set(row, col, 15.0);
    }
  }
}

TEST_P(AllLaws, EnginesAgreeWhereWhatFlowsIsBelowRounding) {
  RelaxationSettings s = settings(GetParam());
  s.tolerance = 0.0;
  s.max_passes = sanitized ? 1'000 : 20'000;
  HeightField tiles = random_bed(20, 20, 0.01, 0.1, 2), plain = tiles;
  const auto a = make_relaxer(s, 0.01)->relax(tiles);
  const auto b = make_plain_relaxer(s, 0.01)->relax(plain);
  EXPECT_TRUE((tiles.grid() == plain.grid()).all());
  EXPECT_EQ(a.passes, b.passes);
  EXPECT_EQ(a.converged, b.converged);
  EXPECT_NEAR(a.residual, b.residual, 0.0);
}

TEST_P(AllLaws, LeavesAResidualWithinTheToleranceAndThenChangesNothing) {
  HeightField bed = random_bed(100, 100, 0.01, 0.1, 3);
  const auto relaxer = make_relaxer(settings(GetParam()), 0.01);
  const auto outcome = relaxer->relax(bed);
  EXPECT_TRUE(outcome.converged);
  EXPECT_LE(outcome.residual, 1e-3 * (1.0 + 1e-9));
  EXPECT_GT(outcome.passes, 0);

  const HeightGrid rest = bed.grid();
  const auto again = make_relaxer(settings(GetParam()), 0.01)->relax(bed);
  EXPECT_EQ(again.passes, 0);
  EXPECT_EQ(again.moved_volume, 0.0);
  EXPECT_TRUE((bed.grid() == rest).all());
  EXPECT_EQ(relaxer->relax(bed).cells_visited, 0);  // nothing was disturbed: nothing is looked at
}

TEST_P(AllLaws, AResidualOfZeroChangesNothingAndZeroPassesIsTheIdentity) {
  HeightField gentle(80, 80, 1.0);
  for (int row = 0; row < 80; ++row)
    for (int col = 0; col < 80; ++col) gentle.set(row, col, 0.4 * col + 0.3 * row);  // slope 0.5 < tan 30
  const HeightGrid before = gentle.grid();
  const auto outcome = make_relaxer(settings(GetParam()), 1.0)->relax(gentle);
  EXPECT_EQ(outcome.residual, 0.0);
  EXPECT_TRUE((gentle.grid() == before).all());

  HeightField rough = random_bed(80, 80, 1.0, 5.0, 4);
  const HeightGrid rough_before = rough.grid();
  RelaxationSettings none = settings(GetParam());
  none.max_passes = 0;
  const auto stopped = make_relaxer(none, 1.0)->relax(rough);
  EXPECT_EQ(stopped.passes, 0);
  EXPECT_GT(stopped.residual, 1.0);
  EXPECT_FALSE(stopped.converged);
  EXPECT_TRUE((rough.grid() == rough_before).all());
}

TEST_P(AllLaws, ConservesVolume) {
  HeightField bed = random_bed(150, 150, 0.01, 0.2, 5);
  const double before = bed.volume();
  const auto outcome = make_relaxer(settings(GetParam()), 0.01)->relax(bed);
  EXPECT_LE(std::abs(bed.volume() - before), 1e-12 * outcome.moved_volume);
}

TEST_P(AllLaws, SymmetricBedsStaySymmetricToTheBit) {
  for (const int side : sanitized ? std::vector{66, 67} : std::vector{130, 131}) {
    SurfaceSettings cylinder;
    cylinder.kind = SurfaceKind::cylinder;
    cylinder.radius = 0.21;
    cylinder.height = 0.3;
    HeightField bed = make_surface(cylinder, side, side, 1.0 / side);
    ASSERT_TRUE(has_square_symmetry(bed.grid()));
    make_relaxer(settings(GetParam()), bed.cell_size())->relax(bed);
    EXPECT_TRUE(has_square_symmetry(bed.grid()));
  }
}

TEST_P(AllLaws, SandMovesByItsNeighbourhoodOnly) {
  // Two piles far apart end as each does alone.
  const auto pile = [](HeightField& bed, int col) {
    for (int row = 30; row < 34; ++row) {
      bed.set(row, col, 3.0);
      bed.set(row, col + 1, 2.0);
    }
  };
  HeightField both(64, 400, 1.0), left(64, 400, 1.0), right(64, 400, 1.0);
  pile(both, 50);
  pile(left, 50);
  pile(both, 350);
  pile(right, 350);
  right.set(20, 350, 4.0);
  both.set(20, 350, 4.0);
  for (HeightField* bed : {&both, &left, &right}) make_relaxer(settings(GetParam()), 1.0)->relax(*bed);
  EXPECT_TRUE((both.grid() == left.grid() + right.grid()).all());
}

/// A heap at rest, as a file or an array brings it, and sand that falls far beside it.
TEST_P(AllLaws, SandAtRestStaysSoWhenARunBegins) {
  for (const RelaxationMethod method : {RelaxationMethod::passes, RelaxationMethod::rkl}) {
    RelaxationSettings s = settings(GetParam());
    s.method = method;
    HeightField heap(200, 400, 1.0);
    for (int row = 60; row < 140; ++row)
      for (int col = 60; col < 140; ++col) heap.set(row, col, 40.0);
    make_relaxer(s, 1.0)->relax(heap);  // its sides lie between tan(talus) and the tolerance above it
    const HeightGrid before = heap.grid();
    HeightField bed(before, 1.0);
    for (int col = 330; col < 350; ++col) bed.set(100, col, 10.0);
    const RelaxationOutcome outcome = make_relaxer(s, 1.0)->relax(bed);
    EXPECT_GT(outcome.passes, 0);
    EXPECT_TRUE(outcome.converged);
    const int beside = 300;
    EXPECT_TRUE((bed.grid().leftCols(beside) == before.leftCols(beside)).all());
    // It was looked at, all the same.
    EXPECT_GT(outcome.residual, 0.5e-3);
    EXPECT_LE(outcome.residual, 1e-3 * (1.0 + 1e-9));
  }
}

/// What is too steep moves, wherever it is: within a tile, across the border of two, and from an untouched
/// tile.
TEST_P(AllLaws, SandTooSteepMovesWhenARunBegins) {
  for (const int col : {0, 30, 63, 64, 127}) {
    for (const double height : {5.0, -5.0}) {
      HeightGrid one = HeightGrid::Zero(70, 128);
      one(40, col) = height;
      HeightField bed(one, 1.0);
      const RelaxationOutcome outcome = make_relaxer(settings(GetParam()), 1.0)->relax(bed);
      EXPECT_GT(outcome.passes, 0) << col << " " << height;
      EXPECT_LE(outcome.residual, 1e-3 * (1.0 + 1e-9)) << col << " " << height;
    }
  }
  HeightField pit(70, 128, 1.0,
                  std::make_shared<LevelRule>(5.0));  // its sides are in a tile that nobody touched
  const int slot = pit.allocate(1);
  for (int row = 0; row < 64; ++row)
    for (int col = 0; col < 64; ++col) pit.tile_heights(slot)[64 * row + col] = 0.0;
  EXPECT_GT(make_relaxer(settings(GetParam()), 1.0)->relax(pit).passes, 0);
  EXPECT_LT(pit(10, 60), 5.0);
}

TEST(IsotropicLaw, StaysWithinTheStartingRange) {  // monotone for c <= 1/4
  HeightField bed = random_bed(100, 100, 0.01, 0.3, 6);
  const double low = bed.grid().minCoeff(), high = bed.grid().maxCoeff();
  make_relaxer(settings(RelaxationLaw::isotropic), 0.01)->relax(bed);
  EXPECT_GE(bed.grid().minCoeff(), low);
  EXPECT_LE(bed.grid().maxCoeff(), high);
}

TEST(TileRelaxer, LooksOnlyAtWhatCanMove) {
  HeightField bed(1024, 1024, 1.0);
  const auto relaxer = make_relaxer(settings(RelaxationLaw::paper), 1.0);
  EXPECT_EQ(relaxer->relax(bed).cells_visited, 0);  // level by rule
  EXPECT_EQ(bed.allocated_tiles(), 0);
  bed.set(63, 64, 0.5);  // below the talus slope: nothing moves
  const auto look = relaxer->relax(bed);
  EXPECT_EQ(look.cells_visited, 5 * 5);  // the cells that can see it, in four tiles
  EXPECT_EQ(look.wake_ups, 4);
  EXPECT_EQ(look.tiles_active_max, 4);
  EXPECT_EQ(look.passes, 0);
  EXPECT_EQ(relaxer->relax(bed).cells_visited, 0);
}

TEST(TileRelaxer, CountsTheMostTilesAtOnce) {
  HeightField bed(64, 64 * 5, 1.0);
  const auto relaxer = make_relaxer(settings(RelaxationLaw::paper), 1.0);
  relaxer->relax(bed);  // the first time all tiles that exist are looked at, and what is beside them
  bed.set(32, 32, 1.0);
  bed.set(32, 4 * 64 + 32, 1.0);  // one pass moves them, and then they rest
  bed.set(32, 2 * 64 + 32, 9.0);  // goes on
  EXPECT_EQ(relaxer->relax(bed).tiles_active_max, 3);
  bed.set(32, 32, 1.0);
  EXPECT_LE(relaxer->relax(bed).tiles_active_max, 1);
}

TEST(TileRelaxer, CountsHowOftenTilesWake) {
  HeightField bed(64, 192, 1.0);
  const auto relaxer = make_relaxer(settings(RelaxationLaw::paper), 1.0);
  EXPECT_EQ(relaxer->relax(bed).wake_ups, 0);
  bed.set(32, 32, 1.0);  // one pass moves it, and then it rests
  EXPECT_EQ(relaxer->relax(bed).wake_ups, 1);
  bed.set(32, 61, 1.0);  // flows within 2 cells of the next tile, which looks and rests
  EXPECT_EQ(relaxer->relax(bed).wake_ups, 2);
  EXPECT_EQ(bed.allocated_tiles(), 2);
}

}  // namespace
}  // namespace sandstroke
