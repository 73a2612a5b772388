// Super-steps helped by coarser beds: how near they come to rkl, in how many passes, and that nothing is lost
// on the way.
#include <gtest/gtest.h>
#include <hwy/targets.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "sand/coarse_sand.h"
#include "sand/initial_surface.h"
#include "sand/relaxation.h"
#include "sand/slope_kernels.h"
#include "sand/symmetry.h"
#include "sanitized.h"

namespace sandstroke {
namespace {

RelaxationSettings settings_of(RelaxationMethod method, RelaxationLaw law = RelaxationLaw::isotropic) {
  RelaxationSettings settings;
  settings.law = law;
  settings.method = method;
  return settings;
}

/// A cylinder of 60 and 80 cells by 512, or the same with other cells.
HeightField cylinder(int rows, int cols, BedShape shape = BedShape::rectangle) {
  SurfaceSettings pile;
  pile.kind = SurfaceKind::cylinder;
  pile.radius = 60.0 / 512.0 * cols;
  pile.height = 80.0 / 512.0 * cols;
  return make_surface(pile, rows, cols, 1.0, shape);
}

RelaxationOutcome relax(HeightField& bed, RelaxationMethod method, RelaxationLaw law) {
  return make_relaxer(settings_of(method, law), 1.0)->relax(bed);
}

double share_elsewhere(const HeightField& bed, const HeightField& other, const HeightField& start) {
  return (bed.grid() - other.grid()).abs().sum() / (other.grid() - start.grid()).abs().sum();
}

class MultilevelLaws : public testing::TestWithParam<RelaxationLaw> {};
INSTANTIATE_TEST_SUITE_P(Laws, MultilevelLaws,
                         testing::Values(RelaxationLaw::isotropic, RelaxationLaw::faces));

TEST_P(MultilevelLaws, BringAPileToRestWhereRklDoesInFewerPasses) {
  const int n = sanitized ? 512 : 1024;
  const HeightField start = cylinder(n, n);
  HeightField bed = start, by_rkl = start;
  const RelaxationOutcome outcome = relax(bed, RelaxationMethod::multilevel, GetParam());
  const RelaxationOutcome of_rkl = relax(by_rkl, RelaxationMethod::rkl, GetParam());
  EXPECT_TRUE(outcome.converged);
  EXPECT_LE(outcome.residual, 1e-3);
  EXPECT_LT(share_elsewhere(bed, by_rkl, start), 0.003);
  EXPECT_LT(outcome.passes, sanitized ? of_rkl.passes : of_rkl.passes / 2);
  EXPECT_NEAR(bed.volume(), start.volume(), 1e-15 * outcome.moved_volume);
  // Both count sand through cells.
  EXPECT_NEAR(outcome.moved_volume, of_rkl.moved_volume, 0.1 * of_rkl.moved_volume);
}

TEST_P(MultilevelLaws, KeepSymmetryToTheBit) {
  HeightField bed = cylinder(512, 512);
  relax(bed, RelaxationMethod::multilevel, GetParam());
  EXPECT_TRUE(has_square_symmetry(bed.grid()));
}

TEST_P(MultilevelLaws, HaveTheBitsOfRklWhereItRestsSoon) {
  HeightField bed = cylinder(150, 150), by_rkl = bed;
  const RelaxationOutcome outcome = relax(bed, RelaxationMethod::multilevel, GetParam());
  EXPECT_EQ(outcome.passes, relax(by_rkl, RelaxationMethod::rkl, GetParam()).passes);
  EXPECT_TRUE((bed.grid() == by_rkl.grid()).all());
}

/// A little sand on a slope that is nearly too steep slides far, but there is too little of it to be worth a
/// coarse bed.
TEST_P(MultilevelLaws, HaveTheBitsOfRklWhereLittleSandMoves) {
  HeightGrid slope(150, 600);
  for (int col = 0; col < 600; ++col) slope.col(col) = -0.97 * std::tan(std::numbers::pi / 6.0) * col;
  slope.block(70, 5, 10, 10) += 12.0;
  HeightField bed(slope, 1.0), by_rkl = bed;
  const RelaxationOutcome outcome = relax(bed, RelaxationMethod::multilevel, GetParam());
  EXPECT_GT(outcome.passes, 256);
  relax(by_rkl, RelaxationMethod::rkl, GetParam());
  EXPECT_TRUE((bed.grid() == by_rkl.grid()).all());
}

TEST_P(MultilevelLaws, LoseNothingAtOddEdges) {
  const HeightField start = cylinder(515, 577);
  HeightField bed = start, by_rkl = start;
  const RelaxationOutcome outcome = relax(bed, RelaxationMethod::multilevel, GetParam());
  EXPECT_TRUE(outcome.converged);
  EXPECT_NEAR(bed.volume(), start.volume(), 1e-15 * outcome.moved_volume);
  const RelaxationOutcome of_rkl = relax(by_rkl, RelaxationMethod::rkl, GetParam());
  EXPECT_NE(outcome.passes, of_rkl.passes);  // something was corrected
  EXPECT_LT(share_elsewhere(bed, by_rkl, start), 0.003);
}

/// A coarse cell cannot be half a wall.
TEST_P(MultilevelLaws, HaveTheBitsOfRklOnBedsWithWalls) {
  for (const BedShape shape : {BedShape::round, BedShape::rectangle}) {
    HeightField bed = cylinder(512, 512, shape);
    if (shape == BedShape::rectangle) bed.set_tool_walls({{bed.allocate(bed.tile_index(4, 6)), 20, 0xff00}});
    HeightField by_rkl = bed;
    const RelaxationOutcome outcome = relax(bed, RelaxationMethod::multilevel, GetParam());
    EXPECT_GT(outcome.passes, 256);
    relax(by_rkl, RelaxationMethod::rkl, GetParam());
    EXPECT_TRUE((bed.grid() == by_rkl.grid()).all());
  }
}

/// A cone that is a little too steep: not so much that the coarse bed, allowed a tenth more, would flow at
/// first.
TEST_P(MultilevelLaws, HelpSandThatIsNearRest) {
  SurfaceSettings cone;
  cone.kind = SurfaceKind::cone;
  cone.radius = 210.0;
  cone.height = 1.08 * 210.0 * std::tan(std::numbers::pi / 6.0);
  const HeightField start = make_surface(cone, 512, 512, 1.0);
  HeightField bed = start, by_rkl = start;
  const RelaxationOutcome outcome = relax(bed, RelaxationMethod::multilevel, GetParam());
  const RelaxationOutcome of_rkl = relax(by_rkl, RelaxationMethod::rkl, GetParam());
  EXPECT_TRUE(outcome.converged);
  EXPECT_LT(outcome.passes, of_rkl.passes);
  EXPECT_NEAR(bed.volume(), start.volume(), 1e-14 * start.volume());
}

TEST_P(MultilevelLaws, GoOnWhereTheyWereCutOff) {
  HeightField bed = cylinder(512, 512);
  RelaxationSettings settings = settings_of(RelaxationMethod::multilevel, GetParam());
  settings.max_passes = 280;
  const auto relaxer = make_relaxer(settings, 1.0);
  std::vector<std::int64_t> told;
  EXPECT_FALSE(
      relaxer->relax(bed, [&](std::int64_t passes, const BedNow&) { told.push_back(passes); }).converged);
  ASSERT_EQ(told.size(), 280u);
  for (std::size_t i = 0; i < told.size(); ++i) EXPECT_EQ(told[i], static_cast<std::int64_t>(i + 1));
  for (int more = 0; more < 50 && !relaxer->relax(bed).converged; ++more) {
  }
  EXPECT_TRUE(relaxer->relax(bed).converged);
}

TEST(Multilevel, HasTheSameBitsForAnyThreadsAndInstructionSet) {
  std::vector<HeightGrid> beds;
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets())
    for (const int threads : sanitized ? std::vector{3} : std::vector{1, 2, 3}) {
      hwy::SetSupportedTargetsForTest(target);
      const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 8);
      tbb::task_arena(threads).execute([&] {
        HeightField bed = cylinder(512, 520);
        relax(bed, RelaxationMethod::multilevel, RelaxationLaw::faces);
        beds.push_back(bed.grid());
      });
      hwy::SetSupportedTargetsForTest(0);
      EXPECT_TRUE((beds.back() == beds.front()).all()) << hwy::TargetName(target) << ", threads " << threads;
    }
}

/// A plane with slope 0.5.
TEST(Multilevel, MeasuresSlopesAsTheLawsDo) {
  HeightField bed(64, 64, 1.0);
  for (int row = 0; row < 64; ++row)
    for (int col = 0; col < 64; ++col) bed.set(row, col, -0.3 * col - 0.4 * row);
  TilePatch patch;
  patch.load_whole(bed, 0);
  TileSlopes slopes;
  for (const RelaxationLaw law : {RelaxationLaw::isotropic, RelaxationLaw::faces}) {
    compute_slopes(talus_law(law, 0.25, 45.0, 0.0, 1.0), patch, slopes);
    for (int row = 2; row < 62; ++row)
      for (int col = 2; col < 62; ++col)
        ASSERT_NEAR(slopes[row * 64 + col], 0.5, 1e-14) << row << ", " << col;
    EXPECT_EQ(slopes[63 * 64 + 63], 0.0);  // the lowest corner gives nothing
  }
}

/// Coarse cells of 2 x 2 fine ones: what is put on one of them lies in its four cells, and a change spreads
/// only among cells that changed.
TEST(Multilevel, BringsBackWhatChangedAndNothingElse) {
  HeightField fine(256, 256, 1.0);
  for (int row = 100; row < 160; ++row)
    for (int col = 100; col < 160; ++col) fine.set(row, col, 0.01 * row);
  const HeightGrid before = fine.grid();
  CoarseSand coarse(fine, settings_of(RelaxationMethod::multilevel), {0, 1, 2, 3}, nullptr, true);
  EXPECT_EQ(coarse.bed()(60, 60), 0.25 * (before.block(120, 120, 2, 2).sum()));
  coarse.bed().set(60, 60, coarse.bed()(60, 60) + 1.0);
  coarse.bed().set(60, 61, coarse.bed()(60, 61) + 0.5);
  coarse.bed().set(70, 70, coarse.bed()(70, 70) - 2.0);
  coarse.bring_back(fine);
  const HeightGrid gain = fine.grid() - before;
  EXPECT_NEAR(gain.sum(), 4.0 * (1.0 + 0.5 - 2.0), 1e-12);
  EXPECT_NEAR(gain(120, 120), 1.0, 1e-14);                     // away from its neighbour
  EXPECT_NEAR(gain(120, 121), 1.0 - 3.0 / 16.0 * 0.5, 1e-14);  // beside it
  EXPECT_NEAR(gain(121, 122), 0.5 + 3.0 / 16.0 * 0.5, 1e-14);
  EXPECT_NEAR(gain(140, 141), -2.0, 1e-14);
  EXPECT_EQ((gain != 0.0).count(), 12);
}

TEST(Multilevel, TakesNoTilesFarFromSandThatMoves) {
  const HeightField fine(HeightGrid::Zero(1024, 1024), 1.0);  // all tiles are allocated
  CoarseSand coarse(fine, settings_of(RelaxationMethod::multilevel), {fine.slot_of(fine.tile_index(8, 8))},
                    nullptr, false);
  EXPECT_EQ(coarse.bed().allocated_tiles(), 25);  // its own, those beside, and what these see
  EXPECT_EQ(coarse.bed().disturbed_tiles().size(), 1u);
  EXPECT_FALSE(coarse.flows());
}

}  // namespace
}  // namespace sandstroke
