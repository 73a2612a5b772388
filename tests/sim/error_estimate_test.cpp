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

HeightField start_of(const Scene& scene) {
  return make_surface(scene.bed.surface, scene.bed.rows, scene.bed.cols, scene.bed.cell_size());
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

TEST(ErrorEstimate, IsNothingWhereNothingMoves) {
  Scene scene = cylinder_scene(32);
  scene.bed.surface.height = 0.0;
  const ErrorEstimate e =
      estimate_error(scene, start_of(scene), {}, solve(scene, start_of(scene), {}), SecondSolution::coarser);
  EXPECT_EQ(e.height_share, 0.0);
  EXPECT_EQ(e.height_rms, 0.0);
  EXPECT_EQ(e.height_max, 0.0);
  EXPECT_EQ(e.force_rms, 0.0);
}

TEST(ErrorEstimate, OfAPlungesForceIsNothingSinceTheForceDependsOnDepthAlone) {
  Scene scene = stroke_scene(50);
  scene.relaxation.rate = 0.0;
  const Stroke plunge = stroke_of(0.0);
  const ErrorEstimate e = estimate_error(scene, start_of(scene), plunge,
                                         solve(scene, start_of(scene), plunge), SecondSolution::coarser);
  EXPECT_GT(e.height_rms, 0.0);
  EXPECT_LT(e.force_max, 1e-9);
}

/// |h - h(truth)| over the changed sand, with cells averaged, and the forces' largest difference.
std::pair<double, double> distance(const Solution& run, const Solution& truth) {
  const HeightGrid coarse = run.surface.grid(), fine = truth.surface.grid();
  const int n = static_cast<int>(coarse.rows()), f = static_cast<int>(fine.rows()) / n;
  double sum = 0.0, force = 0.0;
  for (int row = 0; row < n; ++row)
    for (int col = 0; col < n; ++col)
      sum += std::abs(coarse(row, col) - fine.block(row * f, col * f, f, f).mean());
  for (std::size_t k = 0; k < run.force.size(); ++k)
    force += (run.force[k] - truth.force[f * k]).squaredNorm();
  return {sum / coarse.abs().sum(), std::sqrt(force / static_cast<double>(run.force.size()))};
}

TEST(ErrorEstimate, OfADragIsWithinAFactorOfThreeOfItsDistanceToAQuarterOfTheSteps) {
  const Stroke drag = stroke_of(0.1);
  for (const DeviceModel model : {DeviceModel::kinematic, DeviceModel::dynamic}) {
    Scene scene = stroke_scene(50), fine = scene;
    scene.device.model = fine.device.model = model;
    scene.device.resolution = fine.device.resolution = 0.0;
    for (int halvings = 0; halvings < 2; ++halvings) fine = second_scene(fine, SecondSolution::finer);
    const Solution run = solve(scene, start_of(scene), drag);
    const auto [heights, force] = distance(run, solve(fine, start_of(fine), drag));
    for (const SecondSolution which : {SecondSolution::coarser, SecondSolution::finer}) {
      const ErrorEstimate e = estimate_error(scene, start_of(scene), drag, run, which);
      EXPECT_GT(e.height_share, heights / 3.0);
      EXPECT_LT(e.height_share, heights * 3.0);
      EXPECT_GT(e.force_rms, force / 3.0);
      EXPECT_LT(e.force_rms, force * 3.0);
    }
  }
}

}  // namespace
}  // namespace sandstroke
