// Strokes with a solid tool converge, and their outcome does not depend on speed, relaxations,
// and the noise of hands.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>

#include "haptics/stroke_placement.h"
#include "import/import_stroke.h"
#include "measure/error_estimate.h"
#include "sanitized.h"
#include "validation/study/hand_strokes.h"
#include "validation/study/stroke_replay.h"
#include "validation/study/study.h"

namespace sandstroke {
namespace {

/// Cells and times of a scene divided.
Scene finer(Scene scene, int by) {
  scene.bed.cols *= by;
  scene.bed.rows *= by;
  scene.device.servo_rate *= by;
  return scene;
}

/// The scene that stands for the truth: 20 cells per radius, relaxed twenty times per radius, of a scene that
/// has five.
Scene truth_of(const Scene& scene) {
  Scene truth = finer(scene, 4);
  truth.relaxation.way = truth.relaxation.way_at_rim = 0.05;
  return truth;
}

/// Share of the moved sand that lies elsewhere.
double apart(const Replay& one, const Replay& other) { return judge(one, other).l1; }

const Scene& accurate() {
  static const Scene scene = hand_scene(ModelPreset::accurate);
  return scene;
}

TEST(StrokeConvergence, HoldsForAnSCurveFourMillimetresDeep) {
  const Stroke stroke = s_curve(0.004, 0.25);
  const int finest = sanitized ? 2 : 8;
  const Replay truth = replay(finer(accurate(), finest), stroke);
  std::vector<std::pair<double, double>> errors;
  for (int by = 1; by < finest; by *= 2) {
    const Replay run = replay(finer(accurate(), by), stroke);
    errors.emplace_back(1.0 / by, apart(run, truth));
    EXPECT_LT(run.result.volume_drift, 1e-12);
  }
  EXPECT_LT(errors.front().second, 0.05);
  if (!sanitized) {
    EXPECT_GT(fit_order(errors).order, 0.9);
  }
}

/// The error that a run states for itself, by a finer one.
double estimated_error(const Scene& scene, const Stroke& stroke) {
  const HeightField start(scene.bed.rows, scene.bed.cols, scene.bed.cell_size());
  Kept force(force_of);
  const Solution run = solve(scene, start, stroke, {&force});
  return estimate_error(scene, start, stroke, run, force, SecondSolution::finer).height_share;
}

Scene half_the_way(Scene scene) {
  scene.relaxation.way /= 2;
  scene.relaxation.way_at_rim /= 2;
  return scene;
}

/// Shares of the moved sand: what lies elsewhere with 5 and 10 cells per radius; what half of the way alone
/// changes with each; what a run with 5 estimates of its error. (With 5 cells 0.05 R is the least way, a
/// quarter of a cell, already: where all sand stands high at the rim half of it changes nothing.)
struct Convergence {
  double coarse, middle, way, middle_way, estimate;
};
Convergence convergence_of(const Scene& scene, const Stroke& stroke) {
  const Scene fine = finer(scene, 2);
  const Replay truth = replay(truth_of(scene), stroke), run = replay(scene, stroke),
               fine_run = replay(fine, stroke);
  const Convergence errors{
      apart(run, truth), apart(fine_run, truth), apart(run, replay(half_the_way(scene), stroke)),
      apart(fine_run, replay(half_the_way(fine), stroke)), estimated_error(scene, stroke)};
  std::printf("%.1f %% with 5 cells (estimated %.1f), %.1f %% with 10; half the way %.1f and %.1f %%\n",
              100 * errors.coarse, 100 * errors.estimate, 100 * errors.middle, 100 * errors.way,
              100 * errors.middle_way);
  return errors;
}
/// The estimate is within a factor of 2 of the error.
void expect_true_estimate(double estimate, double error) {
  EXPECT_GT(estimate, 0.5 * error);
  EXPECT_LT(estimate, 2.0 * error);
}

TEST(StrokeConvergence, IsWorseAsDeepAsTheToolsRadius) {
  // The sand that is pushed out and the sand that falls in behind the tool run from one crest, 2 mm from its
  // rim: one cell of five.
  if (sanitized) GTEST_SKIP() << "takes long under sanitizers";
  const Convergence errors = convergence_of(accurate(), s_curve(0.01, 0.25));
  expect_true_estimate(errors.estimate, errors.coarse);
  EXPECT_LT(errors.coarse, 0.13);
  EXPECT_LT(errors.middle, 0.045);
  EXPECT_LT(errors.way, 0.02);
  EXPECT_LT(errors.middle_way, 0.03);
}

TEST(StrokeConvergence, HoldsForAScribbleOverItsOwnGround) {
  if (sanitized) GTEST_SKIP() << "takes long under sanitizers";
  const Convergence errors = convergence_of(accurate(), scribble(0.005, 0.25));
  expect_true_estimate(errors.estimate, errors.coarse);
  EXPECT_LT(errors.coarse, 0.06);
  EXPECT_LT(errors.middle, 0.035);
  EXPECT_LT(errors.way, 0.03);
  EXPECT_LT(errors.middle_way, 0.03);
}

TEST(StrokeConvergence, TwoLawsOfSlopeHaveOneLimit) {
  // 10 mm deep they are 8.5, 7.6 and 6.1 % apart with 5, 10 and 20 cells: there it is slower.
  if (sanitized) GTEST_SKIP() << "takes long under sanitizers";
  const Stroke stroke = s_curve(0.004, 0.25, true);
  std::vector<double> laws_apart;
  for (const int by : {1, 2, 4}) {
    Scene faces = finer(accurate(), by), isotropic = faces;
    isotropic.relaxation.law = RelaxationLaw::isotropic;
    laws_apart.push_back(apart(replay(isotropic, stroke), replay(faces, stroke)));
    std::printf("%d cells: laws are %.1f %% apart\n", 5 * by, 100.0 * laws_apart.back());
  }
  EXPECT_LT(laws_apart[0], 0.04);
  EXPECT_LT(laws_apart[1], 0.6 * laws_apart[0]);
  EXPECT_LT(laws_apart[2], 0.7 * laws_apart[1]);
}

TEST(StrokeConvergence, RelaxationsBesidesThoseByWayChangeLittle) {
  const Stroke stroke = s_curve(0.004, 0.25);
  std::vector<Replay> runs;
  for (const double rate : sanitized ? std::vector{60.0, 240.0} : std::vector{60.0, 240.0, 960.0, 1920.0}) {
    Scene scene = accurate();
    scene.device.servo_rate = 2000.0;
    scene.relaxation.rate = rate;
    runs.push_back(replay(scene, stroke));
    for (const Replay& before : runs) EXPECT_LT(apart(runs.back(), before), 0.03) << rate;
    // The pump: sand that flows into a tool is pushed out of it again with each relaxation.
    EXPECT_LT(runs.back().result.displaced_volume, 1.03 * runs.front().result.displaced_volume) << rate;
  }
}

TEST(StrokeConvergence, ASlowHandLeavesWhatAFastOneLeaves) {
  std::vector<Replay> runs;
  for (const double speed : sanitized ? std::vector{0.25, 1.0} : std::vector{0.02, 0.1, 0.25, 1.0}) {
    runs.push_back(replay(accurate(), s_curve(0.004, speed)));
    for (const Replay& before : runs) EXPECT_LT(apart(runs.back(), before), 0.02) << speed;
    // The sand relaxes at the same positions, so as often, whatever the speed.
    EXPECT_EQ(runs.back().result.relaxations, runs.front().result.relaxations) << speed;
  }
}

TEST(StrokeConvergence, NoiseInHeightDoesNotFillTheFurrow) {
  const Stroke stroke = s_curve(0.004, 0.25);
  const double floor = replay(accurate(), stroke).result.furrow->depth;
  EXPECT_GT(floor, 0.95 * 0.004);
  for (const auto& [noise, most] : {std::pair(2e-6, 0.01), std::pair(10e-6, 0.02), std::pair(55e-6, 0.04)})
    EXPECT_NEAR(replay(accurate(), with_noise(stroke, noise)).result.furrow->depth, floor, most * floor)
        << noise;
}

TEST(StrokeConvergence, NorDoSlopes) {
  const Stroke stroke = s_curve(0.004, 0.25);
  const double floor = replay(accurate(), stroke).result.furrow->depth;
  for (const double rate : {60.0, 960.0}) {
    Scene scene = accurate();
    scene.relaxation.rate = rate;
    EXPECT_NEAR(replay(scene, with_slopes(stroke, 0.05)).result.furrow->depth, floor, 0.03 * floor) << rate;
  }
}

TEST(StrokeConvergence, AFastPenLeavesItsFurrowToo) {
  // 6 m/s: three cells a tick, and sand relaxes within the tick.
  const Replay slow = replay(accurate(), s_curve(0.004, 0.25)),
               fast = replay(accurate(), s_curve(0.004, 6.0));
  EXPECT_LE(std::abs(fast.result.relaxations - slow.result.relaxations),
            2);  // it touches down, and lifts, later
  EXPECT_LT(apart(fast, slow), 0.05);
}

TEST(StrokeConvergence, TheEstimatedErrorIsNearTheTrueOneForHandsToo) {
  if (sanitized) GTEST_SKIP() << "takes long under sanitizers";
  const Stroke clean = s_curve(0.004, 0.25);
  for (const auto& [name, stroke] :
       {std::pair("a slow hand", s_curve(0.004, 0.1)), std::pair("noise", with_noise(clean, 55e-6)),
        std::pair("slopes", with_slopes(clean, 0.05))}) {
    SCOPED_TRACE(name);
    const double truth = apart(replay(accurate(), stroke), replay(truth_of(accurate()), stroke));
    expect_true_estimate(estimated_error(accurate(), stroke), truth);
  }
}

/// Symbol 17 of the Panda data, as a user replays it: laid level, 5 mm deep, R = 6 mm.
class PandaRecording : public testing::Test {
 protected:
  void SetUp() override {
    const std::filesystem::path file =
        std::filesystem::path(SANDSTROKE_SHARED_DATA) / "panda_comanip_force_1khz" / "symbol17_rec2.csv";
    if (!std::filesystem::exists(file)) GTEST_SKIP() << file << " is not there";
    TableSettings table;
    table.rate = 1000.0;
    StrokePlacement placement;
    placement.plane = StrokePlane::fit;
    placement.depth = 0.005;
    recorded = place_stroke(import_stroke(file, table).stroke, placement);
    scene = hand_scene(ModelPreset::accurate);
    scene.tool.radius = 0.006;
    scene.bed.cols = scene.bed.rows = 200;  // five cells per radius
  }

  /// Smooths with a Gaussian that halves the power at `frequency` [Hz].
  Stroke low_passed(double frequency) const {
    Stroke smooth = recorded;
    const double width = std::sqrt(std::log(2.0)) / (2.0 * std::numbers::pi * frequency) * 1000.0;  // samples
    const int reach = static_cast<int>(4.0 * width), last = static_cast<int>(recorded.size()) - 1;
    for (int i = 0; i <= last; ++i) {
      Eigen::Vector3d sum = Eigen::Vector3d::Zero();
      double weights = 0.0;
      for (int k = -reach; k <= reach; ++k) {
        const double weight = std::exp(-0.5 * (k / width) * (k / width));
        sum += weight * recorded.position[std::clamp(i + k, 0, last)];
        weights += weight;
      }
      smooth.position[i] = sum / weights;
    }
    return smooth;
  }

  Stroke recorded;
  Scene scene;
};

TEST_F(PandaRecording, LeavesTheFurrowOfItsSmoothedPath) {
  const double as_recorded = replay(scene, recorded).result.furrow->depth,
               smoothed = replay(scene, low_passed(15.0)).result.furrow->depth;
  EXPECT_NEAR(as_recorded, 0.00305, 0.0001);  // with 20 cells and 0.05 radii of way
  EXPECT_NEAR(as_recorded, smoothed, 0.03 * smoothed);
}

TEST_F(PandaRecording, ConvergesAsCellsAndTicksAreDivided) {
  // The tip is 0.83 radii deep: see the deep S-curve.
  if (sanitized) GTEST_SKIP() << "takes long under sanitizers";
  const Convergence errors = convergence_of(scene, recorded);
  expect_true_estimate(errors.estimate, errors.coarse);
  EXPECT_LT(errors.coarse, 0.07);
  EXPECT_LT(errors.middle, 0.035);
  EXPECT_LT(errors.way, 0.02);
  EXPECT_LT(errors.middle_way, 0.03);
}

}  // namespace
}  // namespace sandstroke
