#include "sim/error_estimate.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"

namespace sandstroke {
namespace {

Scene cylinder_scene(int n) {
  Scene scene;
  scene.bed.cols = scene.bed.rows = n;
  scene.bed.surface.kind = SurfaceKind::cylinder;
  scene.bed.surface.radius = 0.45;
  scene.bed.surface.height = 0.5;
  scene.relaxation.law = RelaxationLaw::isotropic;
  scene.relaxation.method = RelaxationMethod::rkl;
  return scene;
}

/// A hand that sinks 6 mm and drags on at 0.1 m/s, if it drags.
Scene stroke_scene(int n) {
  Scene scene;
  scene.bed.width = scene.bed.depth = 0.1;
  scene.bed.cols = scene.bed.rows = n;
  scene.stroke.emplace();
  scene.stroke->file = "in memory";
  return scene;
}
Stroke stroke_of(double speed) {
  Stroke stroke;
  for (int i = 0; i <= 250; ++i) {
    const double t = 1e-3 * i;
    stroke.time.push_back(t);
    stroke.position.push_back({-0.02 + speed * t, 0.0, -0.006 * std::min(1.0, 10.0 * t)});
  }
  return stroke;
}

TEST(SecondScene, HasEveryStepTwiceOrHalfAsLarge) {
  Scene scene = cylinder_scene(128);
  scene.bed.cols = 192, scene.bed.width = 3.0;
  for (const auto& [which, factor] :
       {std::pair(SecondSolution::coarser, 2.0), std::pair(SecondSolution::finer, 0.5)}) {
    const Scene second = second_scene(scene, which);
    EXPECT_EQ(second.bed.cell_size(), factor * scene.bed.cell_size());
    EXPECT_EQ(second.bed.rows * second.bed.cell_size(), scene.bed.depth);
    EXPECT_EQ(second.device.servo_rate * factor, scene.device.servo_rate);
    EXPECT_EQ(second.relaxation.rate * factor, scene.relaxation.rate);
    EXPECT_EQ(second.relaxation.tolerance, factor * scene.relaxation.tolerance);
    EXPECT_EQ(second.relaxation.step_tolerance, factor * scene.relaxation.step_tolerance);
  }
}

TEST(SecondScene, OddBedsGetCellsAsNearAsSquareOnesFill) {
  Scene scene = cylinder_scene(9);
  EXPECT_EQ(second_scene(scene, SecondSolution::coarser).bed.cols, 5);
  scene.bed.rows = 10, scene.bed.depth = 2.0 / 9.0 * 10.0;
  EXPECT_THROW(second_scene(scene, SecondSolution::coarser), Error);
  EXPECT_EQ(second_scene(scene, SecondSolution::finer).bed.rows, 20);
}

TEST(SecondScene, IsAsLateAsTheRun) {
  Scene scene = stroke_scene(50);
  scene.device.model = DeviceModel::dynamic;
  scene.device.delay = 40;
  for (const SecondSolution which : {SecondSolution::coarser, SecondSolution::finer}) {
    const DeviceSettings second = second_scene(scene, which).device;
    EXPECT_EQ(second.delay / second.servo_rate, 0.040);
  }
  scene.device.delay = 5;
  EXPECT_THROW(second_scene(scene, SecondSolution::coarser), Error);
  EXPECT_EQ(second_scene(scene, SecondSolution::finer).device.delay, 10);
  scene.device.delay = 0, scene.device.dropped_ticks = 0.1;
  EXPECT_THROW(second_scene(scene, SecondSolution::finer), Error);
}

TEST(SecondScene, RefusesCellsThatTheToolDoesNotCover) {
  Scene scene = stroke_scene(10);  // cells of 10 mm, of 20 mm in the coarser one
  scene.tool.radius = 0.006;
  EXPECT_THROW(second_scene(scene, SecondSolution::coarser), Error);
}

/// A run and its forces.
struct FeltRun {
  Kept<Eigen::Vector3d> force{force_of};
  Solution solution;
  explicit FeltRun(const Scene& scene, const std::optional<Stroke>& stroke = {})
      : solution(solve(scene, starting_bed(scene.bed), stroke, {&force})) {}
};

ErrorEstimate estimated(const Scene& scene, const FeltRun& run, const std::optional<Stroke>& stroke,
                        SecondSolution which) {
  return estimate_error(scene, starting_bed(scene.bed), stroke, run.solution, run.force, which);
}

TEST(ErrorEstimate, IsNothingWhereNothingMoves) {
  Scene scene = cylinder_scene(32);
  scene.bed.surface.height = 0.0;
  const ErrorEstimate e = estimated(scene, FeltRun(scene), {}, SecondSolution::coarser);
  EXPECT_EQ(e.height_share, 0.0);
  EXPECT_EQ(e.height_rms, 0.0);
  EXPECT_EQ(e.height_max, 0.0);
  EXPECT_EQ(e.force_rms, 0.0);
}

TEST(ErrorEstimate, OfAPlungesForceIsNothingSinceTheForceDependsOnDepthAlone) {
  Scene scene = stroke_scene(50);
  scene.relaxation.rate = 0.0;
  const Stroke plunge = stroke_of(0.0);
  const ErrorEstimate e = estimated(scene, FeltRun(scene, plunge), plunge, SecondSolution::coarser);
  EXPECT_GT(e.height_rms, 0.0);
  EXPECT_LT(e.force_max, 1e-9);
}

/// |h - h(truth)| over the changed sand, with cells averaged, and the forces' largest difference.
std::pair<double, double> distance(const FeltRun& run, const FeltRun& truth) {
  const HeightGrid coarse = run.solution.surface.grid(), fine = truth.solution.surface.grid();
  const int n = static_cast<int>(coarse.rows()), f = static_cast<int>(fine.rows()) / n;
  double sum = 0.0, force = 0.0;
  for (int row = 0; row < n; ++row)
    for (int col = 0; col < n; ++col)
      sum += std::abs(coarse(row, col) - fine.block(row * f, col * f, f, f).mean());
  const std::vector<Eigen::Vector3d>&of_run = run.force.values, &of_truth = truth.force.values;
  for (std::size_t k = 0; k < of_run.size(); ++k) force += (of_run[k] - of_truth[f * k]).squaredNorm();
  return {sum / coarse.abs().sum(), std::sqrt(force / static_cast<double>(of_run.size()))};
}

TEST(ErrorEstimate, OfADragIsWithinAFactorOfThreeOfItsDistanceToAQuarterOfTheSteps) {
  const Stroke drag = stroke_of(0.1);
  for (const DeviceModel model : {DeviceModel::kinematic, DeviceModel::dynamic}) {
    Scene scene = stroke_scene(50), fine = scene;
    scene.device.model = fine.device.model = model;
    scene.device.resolution = fine.device.resolution = 0.0;
    for (int halvings = 0; halvings < 2; ++halvings) fine = second_scene(fine, SecondSolution::finer);
    const FeltRun run(scene, drag);
    const auto [heights, force] = distance(run, FeltRun(fine, drag));
    for (const SecondSolution which : {SecondSolution::coarser, SecondSolution::finer}) {
      const ErrorEstimate e = estimated(scene, run, drag, which);
      EXPECT_GT(e.height_share, heights / 3.0);
      EXPECT_LT(e.height_share, heights * 3.0);
      EXPECT_GT(e.force_rms, force / 3.0);
      EXPECT_LT(e.force_rms, force * 3.0);
    }
  }
}

}  // namespace
}  // namespace sandstroke
