// Compares super time stepping with a plain whole-field implementation, and checks that it keeps volume,
// range, symmetry and bits.
#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <hwy/targets.h>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "sand/all_laws.h"
#include "sand/initial_surface.h"
#include "sand/relaxation.h"
#include "sand/symmetry.h"
#include "sanitized.h"

namespace sandstroke {
namespace {

RelaxationSettings rkl(RelaxationLaw law = RelaxationLaw::isotropic) {
  RelaxationSettings settings;
  settings.law = law;
  settings.method = RelaxationMethod::rkl;
  return settings;
}

HeightField rough_bed(int rows, int cols, double amplitude, unsigned seed) {
  SurfaceSettings noise;
  noise.kind = SurfaceKind::noise;
  noise.amplitude = amplitude;
  noise.wavelength = 0.0;
  noise.seed = seed;
  return make_surface(noise, rows, cols, 1.0);
}

HeightField cylinder(int side, double radius, double height) {
  SurfaceSettings pile;
  pile.kind = SurfaceKind::cylinder;
  pile.radius = radius;
  pile.height = height;
  return make_surface(pile, side, side, 1.0);
}

/// A law's flow for c = 1 without tolerance, as written down; the steepest slope as a fraction of tan(talus),
/// and the sum of what cells give.
struct PlainFlow {
  HeightGrid gain;
  double steepest = 0.0, given = 0.0;

  PlainFlow(const HeightGrid& h, RelaxationLaw law, double T) : gain(HeightGrid::Zero(h.rows(), h.cols())) {
    for (int row = 0; row < h.rows(); ++row)
      for (int col = 0; col < h.cols(); ++col)
        law == RelaxationLaw::paper       ? paper(h, row, col, T)
        : law == RelaxationLaw::isotropic ? isotropic(h, row, col, T)
                                          : faces(h, row, col, T);
  }

 private:
  static double drop(const HeightGrid& h, int row, int col, int down, int right) {
    const int r = row + down, c = col + right;
    return r < 0 || r >= h.rows() || c < 0 || c >= h.cols() ? 0.0 : h(row, col) - h(r, c);
  }
  void give(int row, int col, int down, int right, double volume) {
    gain(row, col) -= volume;
    gain(row + down, col + right) += volume;
    given += volume;
  }

  void paper(const HeightGrid& h, int row, int col, double T) {
    double most = 0.0, sum = 0.0;
    const auto for_steep = [&](const auto& body) {
      for (int down = -1; down <= 1; ++down)
        for (int right = -1; right <= 1; ++right) {
          const double least = T * (down != 0 && right != 0 ? std::numbers::sqrt2 : 1.0),
                       m = drop(h, row, col, down, right);
          if (down != 0 || right != 0) body(down, right, m, least);
        }
    };
    for_steep([&](int, int, double m, double least) {
      steepest = std::max(steepest, m / least);
      if (m > least) {
        most = std::max(most, m - least);
        sum += m;
      }
    });
    for_steep([&](int down, int right, double m, double least) {
      if (m > least) give(row, col, down, right, most * m / sum);
    });
  }

  void isotropic(const HeightGrid& h, int row, int col, double T) {
    constexpr int steps[4][2] = {{0, -1}, {0, 1}, {-1, 0}, {1, 0}};
    double m[4];
    for (int i = 0; i < 4; ++i) m[i] = std::max(0.0, drop(h, row, col, steps[i][0], steps[i][1]));
    const double slope = std::hypot(std::max(m[0], m[1]), std::max(m[2], m[3]));
    steepest = std::max(steepest, slope / T);
    for (int i = 0; i < 4 && slope > T; ++i)
      if (m[i] > 0.0) give(row, col, steps[i][0], steps[i][1], (1.0 - T / slope) * m[i]);
  }

  void faces(const HeightGrid& h, int row, int col, double T) {
    const auto inside = [&](int r, int c) { return r >= 0 && r < h.rows() && c >= 0 && c < h.cols(); };
    const auto across = [&](int r, int c, int down, int right) {  // central, one-sided at walls
      const bool after = inside(r + down, c + right), before = inside(r - down, c - right);
      return (drop(h, r, c, -down, -right) - drop(h, r, c, down, right)) / (after && before ? 2.0 : 1.0);
    };
    constexpr int steps[4][2] = {{0, -1}, {0, 1}, {-1, 0}, {1, 0}};
    for (const auto& [down, right] : steps) {
      const double m = drop(h, row, col, down, right);
      if (!(m > 0.0)) continue;  // the other cell gives
      const double behind = std::max(0.0, drop(h, row, col, -down, -right));
      const double low = std::min(m, behind), high = std::max(m, behind);
      const int aside = std::abs(right), up = std::abs(down);
      const double sideways =
          0.5 * (across(row, col, aside, up) + across(row + down, col + right, aside, up));
      const double slope = std::hypot(m + low * low / (3.0 * high), sideways);
      steepest = std::max(steepest, slope / T);
      if (slope > T) give(row, col, down, right, (1.0 - T / slope) * m);
    }
  }
};

/// The scheme in whole-field arithmetic, on cells 1 m wide.
RelaxationOutcome plain_rkl(HeightGrid& y, const RelaxationSettings& settings) {
  const double T = talus_slope(settings.talus_angle), limit = 1.0 + settings.tolerance;
  const double low = y.minCoeff(), high = y.maxCoeff();
  RelaxationOutcome outcome;
  const double largest_share = std::min(0.25, flow_share(settings));
  double share = largest_share / 8, travelled = 0.0;
  PlainFlow f(y, settings.law, T);
  while (f.steepest > limit) {
    ++outcome.super_steps;
    const HeightGrid f0 = f.gain;
    HeightGrid z = y;
    const double peak = f0.abs().maxCoeff();
    double tau = 0.0, flowing = 0.0;
    for (int j = 0;; ++j) {
      const double momentum = j / (j + 1.0), step = share * (2.0 * j + 1.0) / (j + 1.0);
      const HeightGrid next = y + momentum * (y - z) + step * f.gain;
      ++outcome.passes;
      if (j > 0 && (next.minCoeff() < low || next.maxCoeff() > high)) {
        ++outcome.rejected_stages;
        break;  // drops this stage
      }
      flowing = momentum * flowing + step * f.given;
      outcome.moved_volume += flowing;
      z = y;
      y = next;
      f = PlainFlow(y, settings.law, T);
      tau = share * (j + 1.0) * (j + 2.0) / 2.0;
      if (f.steepest <= limit) break;
      const double error = 0.5 * tau * (f.gain - f0).abs().maxCoeff() / (travelled + tau * peak);
      if (error * std::pow((j + 3.0) / (j + 1.0), 2) > settings.step_tolerance) break;
      if ((f.gain * f0).sum() < 0.02 * f0.square().sum()) break;
    }
    travelled += tau * peak;
    share = std::min(2.0 * share, largest_share);
  }
  outcome.residual = std::max(0.0, f.steepest - 1.0);
  return outcome;
}

/// Relaxes a bed by the engine and by the plain scheme; returns the engine's outcome.
RelaxationOutcome expect_the_plain_scheme(HeightField& bed, const RelaxationSettings& settings) {
  HeightGrid plain = bed.grid();
  const RelaxationOutcome outcome = make_relaxer(settings, 1.0)->relax(bed),
                          expected = plain_rkl(plain, settings);
  EXPECT_EQ(outcome.passes, expected.passes);
  EXPECT_EQ(outcome.super_steps, expected.super_steps);
  EXPECT_EQ(outcome.rejected_stages, expected.rejected_stages);
  EXPECT_NEAR(outcome.moved_volume, expected.moved_volume, 1e-9 * expected.moved_volume);
  EXPECT_NEAR(outcome.residual, expected.residual, 1e-9);
  EXPECT_LT((bed.grid() - plain).abs().maxCoeff(), 1e-9);  // sums in another order
  EXPECT_TRUE(outcome.converged);
  return outcome;
}

class RklLaws : public testing::TestWithParam<RelaxationLaw> {};
INSTANTIATE_TEST_SUITE_P(Laws, RklLaws, testing::ValuesIn(all_laws), law_name);

TEST_P(RklLaws, IsTheSchemeAsWrittenDown) {
  for (HeightField bed : {cylinder(70, 14.0, 18.0), rough_bed(66, 131, 6.0, 3), rough_bed(40, 7, 30.0, 4)}) {
    const RelaxationOutcome outcome = expect_the_plain_scheme(bed, rkl(GetParam()));
    EXPECT_GT(outcome.super_steps, 2);
    EXPECT_LT(outcome.super_steps, outcome.passes);
    EXPECT_EQ(outcome.rejected_stages, 0);
  }
}

TEST_P(RklLaws, IsTheSameAtAnyLevelOnBedsOfAnyWidth) {
  // A vector's lanes beyond the last column are none of the bed's, whatever stands there.
  for (const int cols : {1, 7, 9, 15, 17, 63, 65}) {
    HeightField ground = rough_bed(11, cols, 5.0, 8);
    const HeightGrid start = ground.grid();
    const RelaxationOutcome expected = make_relaxer(rkl(GetParam()), 1.0)->relax(ground);
    for (const double level : {0.0, 50.0, -50.0}) {
      SCOPED_TRACE(testing::Message() << cols << " columns at " << level << " m");
      HeightField bed(HeightGrid(start + level), 1.0);
      const RelaxationOutcome outcome = expect_the_plain_scheme(bed, rkl(GetParam()));
      EXPECT_EQ(outcome.rejected_stages, 0);
      EXPECT_EQ(outcome.passes, expected.passes);
      EXPECT_LT((bed.grid() - level - ground.grid()).abs().maxCoeff(), 1e-9);
    }
  }
}

TEST_P(RklLaws, ASmallerShareMakesSmallerSteps) {
  RelaxationSettings settings = rkl(GetParam());
  settings.share = 0.06;
  HeightField bed = rough_bed(30, 21, 5.0, 6);
  expect_the_plain_scheme(bed, settings);
}

TEST_P(RklLaws, BeginsAnewWithEachRelaxation) {
  // One that has relaxed a bed before does with the next sand what a new one does.
  HeightField bed = rough_bed(40, 90, 9.0, 2);
  const auto relaxer = make_relaxer(rkl(GetParam()), 1.0);
  relaxer->relax(bed);
  HeightGrid drop = bed.grid();
  drop.block(10, 20, 15, 50) += 12.0;  // on all of what moves, and above what was
  for (int row = 0; row < 40; ++row)
    for (int col = 0; col < 90; ++col) bed.set(row, col, drop(row, col));
  HeightField anew = bed;
  const RelaxationOutcome a = relaxer->relax(bed), b = make_relaxer(rkl(GetParam()), 1.0)->relax(anew);
  EXPECT_EQ(a.passes, b.passes);
  EXPECT_EQ(a.super_steps, b.super_steps);
  EXPECT_EQ(a.rejected_stages, b.rejected_stages);
  EXPECT_EQ(a.moved_volume, b.moved_volume);
  EXPECT_TRUE((bed.grid() == anew.grid()).all());
}

TEST_P(RklLaws, CountTheErrorOfATileWhoseSandRests) {
  // A small heap comes to rest in its own tile while the large one in another goes on.
  HeightGrid heights = HeightGrid::Zero(40, 110);
  heights.block(18, 20, 3, 3) = 6.0;
  heights.block(14, 80, 12, 12) = 11.0;
  HeightField bed(heights, 1.0);
  expect_the_plain_scheme(bed, rkl(GetParam()));
}

TEST_P(RklLaws, ConservesVolumeAndStaysWithinTheStartingRange) {
  for (const unsigned seed : {1u, 2u, 3u, 4u}) {
    HeightField bed = rough_bed(100 + static_cast<int>(seed) * 17, 90, seed * 10.0, seed);
    const HeightGrid start = bed.grid();
    const double before = bed.volume();
    const RelaxationOutcome outcome = make_relaxer(rkl(GetParam()), 1.0)->relax(bed);
    EXPECT_TRUE(outcome.converged);
    EXPECT_LE(outcome.residual, 1e-3 * (1 + 1e-9));
    EXPECT_LE(std::abs(bed.volume() - before), 1e-12 * outcome.moved_volume);
    EXPECT_GE(bed.grid().minCoeff(), start.minCoeff() - 1e-12);
    EXPECT_LE(bed.grid().maxCoeff(), start.maxCoeff() + 1e-12);
  }
}

TEST_P(RklLaws, RestsAndThenChangesNothing) {
  HeightField bed = rough_bed(130, 130, 8.0, 9);
  const auto relaxer = make_relaxer(rkl(GetParam()), 1.0);
  relaxer->relax(bed);
  const HeightGrid rest = bed.grid();
  EXPECT_EQ(relaxer->relax(bed).cells_visited, 0);
  EXPECT_EQ(make_relaxer(rkl(GetParam()), 1.0)->relax(bed).passes, 0);  // one that looks at everything
  RelaxationSettings passes = rkl(GetParam());
  passes.method = RelaxationMethod::passes;
  EXPECT_EQ(make_relaxer(passes, 1.0)->relax(bed).passes, 0);  // both methods mean the same by rest
  EXPECT_TRUE((bed.grid() == rest).all());
}

TEST_P(RklLaws, CutOffAndContinuedItComesToRest) {
  HeightField bed = cylinder(128, 20.0, 25.0);
  const double before = bed.volume();
  RelaxationSettings settings = rkl(GetParam());
  settings.max_passes = 20;
  const auto relaxer = make_relaxer(settings, 1.0);
  RelaxationOutcome outcome;
  double moved = 0.0;
  int calls = 0;
  do {
    outcome = relaxer->relax(bed);
    moved += outcome.moved_volume;
    EXPECT_LE(outcome.passes, 20);
  } while (!outcome.converged && ++calls < 1000);
  EXPECT_TRUE(outcome.converged);
  EXPECT_GT(calls, 2);
  EXPECT_LE(std::abs(bed.volume() - before), 1e-12 * moved);
}

TEST_P(RklLaws, SymmetricBedsStaySymmetricToTheBit) {
  HeightField bed = cylinder(129, 24.0, 30.0);
  make_relaxer(rkl(GetParam()), 1.0)->relax(bed);
  EXPECT_TRUE(has_square_symmetry(bed.grid()));
}

/// A bed and settings with which stages are taken back: rare, for it takes the paper law, steps far too long
/// and few cells. The seeds are some of 20,000 drawn at random where it happens.
struct TooLongSteps {
  HeightGrid heights;
  RelaxationSettings settings = rkl(RelaxationLaw::paper);
  explicit TooLongSteps(unsigned seed) {
    std::mt19937 random(seed);
    const auto whole = [&](int low, int high) {
      return std::uniform_int_distribution<int>(low, high)(random);
    };
    const auto real = [&](double low, double high) {
      return std::uniform_real_distribution<double>(low, high)(random);
    };
    const int rows = whole(1, 40), cols = whole(1, 40);
    heights.resize(rows, cols);
    const double amplitude = real(1, 60), fraction = real(0.01, 0.5);
    for (double& height : heights.reshaped())
      height = real(0, 1) < fraction ? real(-amplitude, amplitude) : 0.0;
    settings.step_tolerance = 10.0;
    settings.talus_angle = real(5, 60);
  }
};
constexpr unsigned too_long_steps[] = {2076, 8544, 8958, 12450, 16674, 16902, 18402};

TEST(Rkl, TakesBackStagesThatLeaveTheRange) {
  for (const double level : {0.0, 100.0, -100.0}) {
    std::int64_t taken_back = 0;
    for (const unsigned seed : too_long_steps) {
      SCOPED_TRACE(testing::Message() << "seed " << seed << " at " << level << " m");
      TooLongSteps scene(seed);
      scene.heights += level;
      HeightField bed(scene.heights, 1.0);
      const double before = bed.volume();
      const RelaxationOutcome outcome = expect_the_plain_scheme(bed, scene.settings);
      taken_back += outcome.rejected_stages;
      EXPECT_GE(bed.grid().minCoeff(), scene.heights.minCoeff());
      EXPECT_LE(bed.grid().maxCoeff(), scene.heights.maxCoeff());
      EXPECT_NEAR(bed.volume(), before, 1e-12 * (outcome.moved_volume + std::abs(before)));
    }
    EXPECT_GT(taken_back, 0);
  }
}

TEST(Rkl, WorksOnWhatIsDisturbedOnly) {
  HeightField bed = cylinder(512, 60.0, 80.0);
  const auto relaxer = make_relaxer(rkl(), 1.0);
  relaxer->relax(bed);  // a cone whose sides all lie between tan(talus) and the tolerance above it
  const HeightGrid cone = bed.grid();
  bed.set(256, 330, bed(256, 330) + 1.0);
  const RelaxationOutcome outcome = relaxer->relax(bed);
  EXPECT_GT(outcome.passes, 0);
  EXPECT_LT(outcome.cells_visited, outcome.passes * 120 * 120);
  EXPECT_EQ((bed.grid() - cone).leftCols(250).abs().maxCoeff(), 0.0);
}

TEST(Rkl, HasTheSameBitsForAnyThreadsAndInstructionSet) {
  std::vector<HeightGrid> beds;
  std::vector<std::int64_t> passes;
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets())
    for (const int threads : sanitized ? std::vector{1, 3} : std::vector{1, 2, 3, 8}) {
      hwy::SetSupportedTargetsForTest(target);
      const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 8);
      tbb::task_arena(threads).execute([&] {
        HeightField bed = rough_bed(230, 270, 12.0, 5);
        passes.push_back(make_relaxer(rkl(), 1.0)->relax(bed).passes);
        beds.push_back(bed.grid());
      });
      hwy::SetSupportedTargetsForTest(0);
      EXPECT_EQ(passes.back(), passes.front()) << hwy::TargetName(target) << ", threads " << threads;
      EXPECT_TRUE((beds.back() == beds.front()).all()) << hwy::TargetName(target) << ", threads " << threads;
    }
}

TEST(Rkl, ASmallerStepToleranceTakesMorePasses) {
  std::int64_t last = 0;
  for (const double tolerance : {1.0, 0.1, 0.01, 0.001}) {
    HeightField bed = cylinder(128, 20.0, 25.0);
    RelaxationSettings settings = rkl();
    settings.step_tolerance = tolerance;
    const std::int64_t passes = make_relaxer(settings, 1.0)->relax(bed).passes;
    EXPECT_GT(passes, last);
    last = passes;
  }
}

}  // namespace
}  // namespace sandstroke
