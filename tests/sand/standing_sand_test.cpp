#include "sand/standing_sand.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <random>

#include "sand/ground.h"
#include "sand/symmetry.h"
#include "sanitized.h"

namespace sandstroke {
namespace {

constexpr double friction_angle = 33.0, weight = 1600.0 * 9.81, cohesion = 150.0;  // deg, N/m^3, Pa
const double loose_slope = std::tan(friction_angle * std::numbers::pi / 180.0);

MoistureSettings moist(double pascal = cohesion, SlipSurface surface = SlipSurface::plane) {
  MoistureSettings moisture;
  moisture.cohesion = pascal;
  moisture.surface = surface;
  return moisture;
}
RelaxationSettings law(RelaxationMethod method = RelaxationMethod::rkl) {
  RelaxationSettings settings;
  settings.law = RelaxationLaw::isotropic;
  settings.method = method;
  settings.talus_angle = friction_angle;
  return settings;
}
std::unique_ptr<Relaxer> relaxer_of(const HeightField& bed, const MoistureSettings& moisture,
                                    RelaxationMethod method = RelaxationMethod::rkl) {
  return make_standing_relaxer(make_relaxer(law(method), bed.cell_size()), bed,
                               {CohesionFactor(moisture.surface, friction_angle),
                                {moisture.cohesion / weight},
                                moisture.dries / weight,
                                moisture.heals,
                                loose_slope});
}
/// The height of a vertical cut that just stands [m].
double height_of_cut(double pascal = cohesion) {
  return critical_height(SlipSurface::plane, 90.0, friction_angle) * pascal / weight;
}

/// height(x, y), from the middle of a square bed.
HeightField bed_of(int side, double cell, const std::function<double(double, double)>& height) {
  HeightGrid heights(side, side);
  const double middle = 0.5 * side;
  for (int row = 0; row < side; ++row)
    for (int col = 0; col < side; ++col)
      heights(row, col) = height((col + 0.5 - middle) * cell, (row + 0.5 - middle) * cell);
  return HeightField(heights, cell);
}
/// A vertical cut through the middle of a bed, turned by so many degrees.
HeightField cut(double height, int cells, double turn) {
  const double cell = height_of_cut() / cells, angle = turn * std::numbers::pi / 180.0;
  return bed_of(static_cast<int>(3.2 * cells), cell, [&](double x, double y) {
    return x * std::cos(angle) + y * std::sin(angle) > 0.1 * cell ? height : 0.0;
  });
}
/// Blocks of sand of random heights, some cells wide.
HeightField rough(unsigned seed, int side, int block, double most) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> one(0.0, most);
  HeightGrid blocks(side, side), heights(side, side);
  for (double& height : blocks.reshaped()) height = one(random);
  for (int row = 0; row < side; ++row)
    for (int col = 0; col < side; ++col) heights(row, col) = blocks(row / block, col / block);
  return HeightField(heights, 0.002);
}

TEST(StandingSand, AWallStandsAt98PercentOfItsHeightAndNoBitChanges) {
  for (const int cells : {20, 40})
    for (const double turn : {0.0, 22.5, 45.0}) {
      HeightField bed = cut(0.98 * height_of_cut(), cells, turn);
      const HeightGrid before = bed.grid();
      const RelaxationOutcome outcome = relaxer_of(bed, moist())->relax(bed);
      EXPECT_TRUE(outcome.converged);
      EXPECT_EQ(outcome.passes, 0) << cells << " " << turn;
      EXPECT_TRUE((bed.grid() == before).all());
    }
}

// Rankine: the plane that fails first is 45 + phi / 2 steep.
TEST(StandingSand, AWallFailsAt102PercentAndItsCrestStepsBackByRankinesWedge) {
  const double steepest = std::tan((45.0 + 0.5 * friction_angle) * std::numbers::pi / 180.0);
  for (const int cells : {20, 40}) {
    const double height = 1.02 * height_of_cut();
    HeightField bed = cut(height, cells, 0.0);
    const double volume = bed.volume();
    const RelaxationOutcome outcome = relaxer_of(bed, moist())->relax(bed);
    EXPECT_TRUE(outcome.converged);
    EXPECT_GT(outcome.passes, 10);
    EXPECT_NEAR(bed.volume() / volume, 1.0, 1e-14);
    const int row = bed.rows() / 2;
    int crest = bed.cols() / 2;
    while (crest < bed.cols() - 1 && bed(row, crest) < height) ++crest;
    const double back = (crest - 0.5 * bed.cols()) * bed.cell_size();
    EXPECT_NEAR(back, height / steepest, 0.05 * height_of_cut() + bed.cell_size()) << cells;
    // Loose sand in front lies at the talus.
    for (int col = 0; col + 1 < bed.cols() / 2; ++col)
      EXPECT_LE(bed(row, col + 1) - bed(row, col), loose_slope * bed.cell_size() * 1.002);
  }
}

TEST(StandingSand, WithoutCohesionLeftItLiesAsDrySandDoes) {
  HeightField bed = cut(0.5 * height_of_cut(), 20, 22.5), dry = bed;
  MoistureSettings moisture = moist();
  moisture.dries = 1.0;
  const std::unique_ptr<Relaxer> relaxer = relaxer_of(bed, moisture);
  EXPECT_EQ(relaxer->relax(bed).passes, 0);
  relaxer->set_time(cohesion);
  EXPECT_TRUE(relaxer->relax(bed).converged);
  make_relaxer(law(), dry.cell_size())->relax(dry);
  const double moved = (dry.grid() - cut(0.5 * height_of_cut(), 20, 22.5).grid()).abs().sum();
  EXPECT_LT((bed.grid() - dry.grid()).abs().sum(), 0.1 * moved);
}

TEST(StandingSand, DrySandBesideMoistSandLiesAsAllSandDoes) {
  // A long wall, moist on one side of the middle.
  const double height = 0.8 * height_of_cut(), cell = height_of_cut() / 40;
  const auto wall = [&](double x, double) { return x > 0.0 ? height : 0.0; };
  HeightField bed = bed_of(128, cell, wall), dry = bed;
  auto by_place = std::make_shared<HeightField>(128, 128, cell);
  for (int row = 0; row < 64; ++row)
    for (int col = 0; col < 128; ++col) by_place->set(row, col, cohesion / weight);
  const std::unique_ptr<Relaxer> relaxer = make_standing_relaxer(
      make_relaxer(law(), cell), bed,
      {CohesionFactor(SlipSurface::plane, friction_angle), {0.0, by_place}, 0.0, true, loose_slope});
  EXPECT_TRUE(relaxer->relax(bed).converged);
  make_relaxer(law(), cell)->relax(dry);
  for (int col = 0; col < 128; ++col) {
    EXPECT_EQ(bed(4, col), wall(col - 63.5, 0.0));
    EXPECT_NEAR(bed(124, col), dry(124, col), 1e-3 * height);
  }
  const HeightGrid stood = bed.grid();  // and goes on doing so
  bed.set(100, 100, bed(100, 100) + 0.5 * cell);
  relaxer->relax(bed);
  EXPECT_LT((bed.grid() - stood).abs().sum(), 4.0 * cell);
}

TEST(StandingSand, ATowerThatDriesCollapsesOnceAndSymmetrically) {
  const double cell = 0.001;
  const auto tower = [&](double x, double y) { return std::hypot(x, y) < 0.02 ? 0.07 : 0.01; };
  HeightField bed = bed_of(96, cell, tower);
  MoistureSettings moisture = moist(600.0);
  moisture.dries = 1.0;
  const std::unique_ptr<Relaxer> relaxer = relaxer_of(bed, moisture);
  double last = bed.highest();
  int collapses = 0;
  for (const double left : {600.0, 300.0, 200.0, 150.0, 120.0, 80.0}) {
    relaxer->set_time(600.0 - left);
    relaxer->relax(bed);
    collapses += bed.highest() < 0.9 * last;
    if (left >= 150.0) {  // the design's: it needs 0.87 of that
      EXPECT_EQ(bed.highest(), 0.07) << left;
    }
    last = bed.highest();
  }
  EXPECT_EQ(collapses, 1);
  EXPECT_TRUE(has_square_symmetry(bed.grid()));
}

TEST(StandingSand, OnlyCutSandIsIntactThatHasCometoRest) {
  // A heap that was put down is loose: it flows, and what it lies on stands.
  const double height = 0.9 * height_of_cut();
  HeightField bed = cut(height, 20, 0.0);
  const std::unique_ptr<Relaxer> relaxer = relaxer_of(bed, moist());
  relaxer->relax(bed);
  const HeightGrid stood = bed.grid();
  const int row = bed.rows() / 2, col = bed.cols() * 3 / 4;
  for (int r = -2; r <= 2; ++r)
    for (int c = -2; c <= 2; ++c) bed.set(row + r, col + c, height + 8.0 * bed.cell_size());
  EXPECT_GT(relaxer->relax(bed).passes, 0);
  EXPECT_LT(bed.highest(), height + 8.0 * bed.cell_size());
  EXPECT_TRUE((bed.grid() >= stood).all());
}

TEST(StandingSand, SandThatHealsStandsWhereItIsCutAgain) {
  for (const bool heals : {true, false}) {
    HeightField bed = bed_of(96, 0.001, [](double x, double) { return x < 0.0 ? 0.0 : 0.02; });
    MoistureSettings moisture = moist();
    moisture.heals = heals;
    const std::unique_ptr<Relaxer> relaxer = relaxer_of(bed, moisture);
    relaxer->relax(bed);
    // A heap is put down and comes to rest; then half of it is cut away.
    for (int row = 20; row < 76; ++row)
      for (int col = 60; col < 90; ++col) bed.set(row, col, 0.04);
    relaxer->relax(bed);
    const HeightGrid heap = bed.grid();
    for (int row = 20; row < 76; ++row)
      for (int col = 75; col < 96; ++col) bed.set(row, col, std::min(bed(row, col), 0.02));
    relaxer->relax(bed);
    EXPECT_EQ(bed(48, 74) == heap(48, 74), heals);
  }
}

TEST(StandingSand, HostileBedsEndWithAllTheirSand) {
  const unsigned last = sanitized ? 1 : 17;
  for (unsigned seed = 1; seed <= last; ++seed)
    for (const double most : {0.05, 0.15, 0.5})
      for (const int block : {1, 8}) {
        HeightField bed = rough(seed, 96, block, most);
        const double volume = bed.volume();
        const std::unique_ptr<Relaxer> relaxer = relaxer_of(bed, moist(), RelaxationMethod::rkl);
        const RelaxationOutcome outcome = relaxer->relax(bed);
        EXPECT_TRUE(outcome.converged) << seed << " " << most << " " << block;
        EXPECT_NEAR(bed.volume() / volume, 1.0, 1e-14);
        EXPECT_TRUE(std::isfinite(bed.volume()));
        // What stands is left alone.
        const HeightGrid stood = bed.grid();
        const RelaxationOutcome again = relaxer->relax(bed);
        EXPECT_EQ(again.passes, 0) << seed << " " << most << " " << block;
        EXPECT_EQ(again.failed_volume, 0.0);
        EXPECT_TRUE((bed.grid() == stood).all());
      }
}

/// The cuts' level by the plain rule.
CutsLook plain_look(const HeightField& bed, const HeightGrid& level, double pascal,
                    const CohesionFactor& factor) {
  const HeightGrid heights = bed.grid();
  HeightGrid floor(bed.rows(), bed.cols());
  WallGrid walls(bed.rows(), bed.cols());
  for (int row = 0; row < bed.rows(); ++row)
    for (int col = 0; col < bed.cols(); ++col) {
      floor(row, col) = bed.floor(row, col);
      walls(row, col) = bed.is_wall(row, col);
    }
  return look_at_cuts(heights, level, floor, HeightGrid::Constant(bed.rows(), bed.cols(), pascal / weight),
                      walls, factor, bed.cell_size());
}

TEST(StandingSand, LooksHaveTheBitsOfThePlainRule) {
  const CohesionFactor factor(SlipSurface::spiral, friction_angle);
  for (unsigned seed = 1; seed <= 4; ++seed) {
    HeightField bed = rough(seed, 150, 12, 0.12);
    if (seed > 2) {  // bare in places
      auto ground = std::make_shared<Ground>(bed, loose_slope);
      for (int row = 40; row < 90; ++row)
        for (int col = 30; col < 100; ++col) ground->floor.set(row, col, 0.06);
      bed.lie_on(ground);
    }
    StandingCuts cuts(bed, factor);
    HeightGrid level = cuts.level().grid();
    for (int round = 0; round < 3; ++round) {
      const CutsLook plain = plain_look(bed, level, cohesion, factor);
      const StandingCuts::Look look = cuts.look(bed, {cohesion / weight});
      EXPECT_EQ(look.failed, plain.failed) << seed << " " << round;
      if (round == 0) {
        EXPECT_GT(look.failed, 0);
      }
      level = plain.intact;
      EXPECT_TRUE((cuts.level().grid() == level).all()) << seed << " " << round;
      // Somebody takes sand away.
      std::mt19937 random(seed);
      for (int i = 0; i < 200; ++i) {
        const int row = static_cast<int>(random() % 150), col = static_cast<int>(random() % 150);
        bed.set(row, col, std::max(bed.floor(row, col), 0.5 * bed(row, col)));
        level(row, col) = std::min(level(row, col), bed(row, col));
      }
      cuts.cut(bed, {cohesion / weight});
      bed.clear_disturbed();
    }
  }
}

TEST(StandingSand, WhereNothingChangedNothingIsLookedAt) {
  HeightField bed = cut(0.9 * height_of_cut(), 60, 0.0);
  StandingCuts cuts(bed, CohesionFactor(SlipSurface::plane, friction_angle));
  const Cohesion there{cohesion / weight};
  EXPECT_GT(cuts.look(bed, there).toes, 0);
  EXPECT_EQ(cuts.look(bed, there).tiles, 0);
  bed.set(5, bed.cols() - 5, bed(5, bed.cols() - 5) + 1e-6);  // far behind the cut
  const StandingCuts::Look look = cuts.look(bed, there);
  EXPECT_GT(look.tiles, 0);
  EXPECT_LT(look.tiles, bed.tile_count());
}

TEST(StandingSand, LowSandIsNotLookedAt) {
  HeightField bed = cut(0.49 * height_of_cut(), 60, 0.0);
  StandingCuts cuts(bed, CohesionFactor(SlipSurface::plane, friction_angle));
  EXPECT_EQ(cuts.look(bed, {cohesion / weight}).tiles, 0);
}

TEST(StandingSand, HasTheSameBitsOnAnyNumberOfThreads) {
  HeightGrid one;
  for (const int threads : {1, 4}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    HeightField bed = rough(7, 150, 10, 0.2);
    relaxer_of(bed, moist())->relax(bed);
    if (threads == 1)
      one = bed.grid();
    else
      EXPECT_TRUE((bed.grid() == one).all());
  }
}

TEST(StandingSand, GoesOnFromItsState) {
  const auto shave = [](HeightField& bed, int col) {
    for (int row = 0; row < bed.rows(); ++row)
      for (int c = col; c < col + 8; ++c) bed.set(row, c, std::min(bed(row, c), 0.01));
  };
  HeightField bed = rough(8, 100, 10, 0.1);
  const std::unique_ptr<Relaxer> relaxer = relaxer_of(bed, moist());
  relaxer->relax(bed);
  shave(bed, 30);
  StateKeeper keeper;
  bed.visit_state(keeper);
  relaxer->visit_state(keeper);
  const std::string state = std::move(keeper).kept();
  HeightField other = rough(8, 100, 10, 0.1);
  const std::unique_ptr<Relaxer> again = relaxer_of(other, moist());
  StateRestorer restorer(state);
  other.visit_state(restorer);
  again->visit_state(restorer);
  restorer.end();
  for (HeightField* one : {&bed, &other}) {
    Relaxer& its = one == &bed ? *relaxer : *again;
    its.relax(*one);
    shave(*one, 60);
    its.relax(*one);
  }
  EXPECT_TRUE((bed.grid() == other.grid()).all());
}

}  // namespace
}  // namespace sandstroke
