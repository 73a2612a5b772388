#include "measure/error_estimate.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "core/error.h"
#include "rules/talus.h"
#include "sim/two_drags.h"

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
  scene.bed.cols = 192;
  scene.bed.width = 3.0;
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
  scene.bed.rows = 10;
  scene.bed.depth = 2.0 / 9.0 * 10.0;
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
  scene.device.delay = 0;
  scene.device.dropped_ticks = 0.1;
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

TEST(ErrorEstimate, IsNothingBeyondARoundWall) {
  Scene scene = cylinder_scene(32);
  scene.bed.shape = BedShape::round;
  scene.bed.surface.kind = SurfaceKind::noise;
  scene.bed.surface.amplitude = 0.2;
  scene.bed.surface.wavelength = 0.0;  // cells are split
  const FeltRun run(scene);
  HeightField map(32, 32, scene.bed.cell_size());
  const ErrorEstimate e = estimate_error(scene, starting_bed(scene.bed), {}, run.solution, run.force,
                                         SecondSolution::finer, &map);
  EXPECT_GT(e.height_rms, 0.0);
  for (int row = 0; row < 3; ++row)
    for (int col = 0; col < 3; ++col) EXPECT_NEAR(map(row, col), 0.0, 1e-15) << row << ", " << col;
}

/// A cone over a seam of two kinds of sand, that a map in these cells gives; level: one kind.
Scene cone_on_a_map(int n, int map_cells, bool level = false) {
  Scene scene = cylinder_scene(n);
  scene.relaxation.talus_angle = 25.0;
  HeightGrid slopes = HeightGrid::Constant(map_cells, map_cells, talus_slope(25.0));
  if (!level) slopes.rightCols(map_cells / 2).setConstant(talus_slope(35.0));
  scene.ground.map.emplace().file = "in memory";
  scene.ground.map->slopes = std::make_shared<HeightGrid>(slopes);
  return scene;
}

ErrorEstimate estimated_on_ground(const Scene& scene, SecondSolution which) {
  const HeightField start = on_ground(starting_bed(scene.bed), scene);
  Kept force(force_of);
  const Solution run = solve(scene, start, {}, {&force});
  return estimate_error(scene, start, {}, run, force, which);
}

TEST(ErrorEstimate, TakesTheMeansOfAMapOfTheSand) {
  for (const SecondSolution which : {SecondSolution::coarser, SecondSolution::finer}) {
    // The seam is between cells of all three beds: averaged and split, the map is what it is in their cells.
    const Scene scene = cone_on_a_map(64, 64), of_others = cone_on_a_map(64, 32);
    const ErrorEstimate one = estimated_on_ground(scene, which),
                        other = estimated_on_ground(of_others, which);
    EXPECT_EQ(one.height_rms, other.height_rms);
    EXPECT_GT(one.height_rms, 0.0);
    // One kind of sand everywhere has the bits of no map, also in cells that do not divide each other.
    for (const int cells : {64, 27}) {
      const Scene level = cone_on_a_map(cells, cells, true);
      Scene none = level;
      none.ground = {};
      EXPECT_EQ(estimated_on_ground(level, which).height_rms, estimated_on_ground(none, which).height_rms);
    }
  }
}

TEST(ErrorEstimate, IsZeroForAPlungesForceWhichDependsOnDepthAlone) {
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

TEST(ErrorEstimate, IsWithinAFactorOfThreeOfADragsDistanceToAQuarterOfTheSteps) {
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

/// Mean heights in the cells of another bed over the same rectangle, summed over pieces that divide the cells
/// of both.
HeightGrid averaged(const HeightGrid& heights, Eigen::Index rows, Eigen::Index cols) {
  const Eigen::Index all_down = std::lcm(heights.rows(), rows), all_across = std::lcm(heights.cols(), cols);
  const Eigen::Index down = all_down / rows, across = all_across / cols;  // pieces of a cell of the other bed
  HeightGrid means = HeightGrid::Zero(rows, cols);
  for (Eigen::Index i = 0; i < all_down; ++i)
    for (Eigen::Index j = 0; j < all_across; ++j)
      means(i / down, j / across) += heights(i * heights.rows() / all_down, j * heights.cols() / all_across);
  return means / static_cast<double>(down * across);
}

/// Root mean square and largest, over what is not zero in `where`.
std::pair<double, double> rms_and_max(const std::vector<double>& values, const std::vector<double>& where) {
  double squares = 0.0, most = 0.0, count = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    squares += values[i] * values[i];
    most = std::max(most, values[i]);
    count += where[i] != 0.0;
  }
  return {std::sqrt(squares / count), most};
}

/// Expects the estimate by its definition, cell by cell: the distance of a run from its second solution,
/// times Richardson's factor.
void expect_richardson(const Scene& scene, const std::optional<Stroke>& stroke, SecondSolution which,
                       const HeightField& start, const HeightField& second_start) {
  Kept force(force_of), second_force(force_of);
  const Solution run = solve(scene, start, stroke, {&force});
  const Scene second_settings = second_scene(scene, which);
  const Solution second = solve(second_settings, second_start, stroke, {&second_force});
  const ErrorEstimate e = estimate_error(scene, start, stroke, run, force, which);

  const bool coarser = which == SecondSolution::coarser;
  const HeightGrid ran = run.surface.grid(), other = second.surface.grid();
  const HeightGrid coarse = coarser ? other : ran, fine = coarser ? ran : other;
  const HeightGrid apart = (averaged(fine, coarse.rows(), coarse.cols()) - coarse).abs();
  const HeightGrid changed = (ran - start.grid()).abs();
  const double ratio = static_cast<double>(fine.rows()) / static_cast<double>(coarse.rows());
  const double factor = (coarser ? 1.0 : ratio) / (ratio - 1.0);
  const double area = run.surface.cell_area(), coarse_area = (coarser ? second : run).surface.cell_area();
  const auto changed_cells = static_cast<double>((changed > 0.0).count());
  ASSERT_GT(apart.maxCoeff(), 0.0);
  EXPECT_NEAR(e.height_max / (factor * apart.maxCoeff()), 1.0, 1e-9);
  EXPECT_NEAR(e.height_share / (factor * apart.sum() * coarse_area / (changed.sum() * area)), 1.0, 1e-9);
  const double rms = std::sqrt(apart.square().sum() * coarse_area / (changed_cells * area));
  EXPECT_NEAR(e.height_rms / (factor * rms), 1.0, 1e-9);
  EXPECT_EQ(e.at_rest, run.result.relaxation.converged && second.result.relaxation.converged);
  EXPECT_GT(e.wall_seconds, 0.0);
  if (!stroke) return;
  const auto &coarse_force = coarser ? second_force.values : force.values,
             &fine_force = coarser ? force.values : second_force.values;
  std::vector<double> differences, felt;
  for (std::size_t k = 0; k < coarse_force.size(); ++k) {
    differences.push_back((coarse_force[k] - fine_force[2 * k]).norm());
    felt.push_back(coarse_force[k].norm());
  }
  const auto [force_rms, force_max] = rms_and_max(differences, felt);
  ASSERT_GT(force_max, 0.0);
  EXPECT_NEAR(e.force_rms / ((coarser ? 1.0 : 2.0) * force_rms), 1.0, 1e-9);
  EXPECT_NEAR(e.force_max / ((coarser ? 1.0 : 2.0) * force_max), 1.0, 1e-9);
}

TEST(ErrorEstimate, IsTheDistanceToTheSecondSolutionTimesRichardsonsFactor) {
  // Over tiles of a bed that is not square, near its end along x: the coarser one has 1 x 3 of them, the
  // finer one 3 x 10.
  Scene drag = stroke_scene(300);
  drag.bed.width = 0.6;
  drag.bed.rows = 90;
  drag.bed.depth = 0.18;
  // The tool is in the air for the first 20 of 250 ms: ticks without a force.
  Stroke stroke = stroke_of(0.1);
  for (Eigen::Vector3d& position : stroke.position) position += Eigen::Vector3d(0.26, 0.0, 1.2e-3);
  for (const SecondSolution which : {SecondSolution::coarser, SecondSolution::finer}) {
    const Scene second = second_scene(drag, which);
    expect_richardson(drag, stroke, which, starting_bed(drag.bed), starting_bed(second.bed));
  }
}

TEST(ErrorEstimate, TakesCommonPartsOfCellsWhereNoSquareCellsHalveTheBed) {
  // 9 x 27 cells, and 5 x 15: each of these covers 1.8 of those along each side.
  Scene heap = cylinder_scene(9);
  heap.bed.cols = 27;
  heap.bed.width = 6.0;
  heap.relaxation.tolerance = 1e-2;
  ASSERT_EQ(second_scene(heap, SecondSolution::coarser).bed.cols, 15);
  expect_richardson(heap, {}, SecondSolution::coarser, starting_bed(heap.bed),
                    starting_bed(second_scene(heap, SecondSolution::coarser).bed));
}

TEST(ErrorEstimate, ItsMapIsAsSymmetricAsTheBedWhateverTheRatioOfCells) {
  for (const int n : {15, 16}) {  // cells 1.875 and 2 times as large
    const Scene scene = cylinder_scene(n);
    const HeightField start = starting_bed(scene.bed);
    const Solution run = solve(scene, start);
    for (const SecondSolution second : {SecondSolution::coarser, SecondSolution::finer}) {
      HeightField map(n, n, scene.bed.cell_size());
      const ErrorEstimate error = estimate_error(scene, start, {}, run, Kept(force_of), second, &map);
      const HeightGrid heights = map.grid();
      EXPECT_GT(heights.maxCoeff(), 0.1 * error.height_max);
      EXPECT_LE(heights.maxCoeff(), error.height_max * (1.0 + 1e-12));
      EXPECT_LT((heights - heights.rowwise().reverse()).abs().maxCoeff(), 1e-6 * error.height_max) << n;
      EXPECT_LT((heights - heights.colwise().reverse()).abs().maxCoeff(), 1e-6 * error.height_max) << n;
    }
  }
}

TEST(ErrorEstimate, CellsThatNoRuleMakesAnewAreAveragedOrSplit) {
  Scene rough = stroke_scene(20);
  rough.stroke.reset();
  rough.bed.rows = 30;
  rough.bed.depth = 0.15;
  rough.bed.surface.kind = SurfaceKind::noise;
  rough.bed.surface.wavelength = 0.0;
  rough.bed.surface.amplitude = 0.02;
  // Heights of which sums and halves are exact: of beds that differ by rounding other cells may come to rest.
  const HeightGrid steps = (starting_bed(rough.bed).grid() * 0x1p20).round() * 0x1p-20;
  const HeightField start(steps, rough.bed.cell_size());
  for (const SecondSolution which : {SecondSolution::coarser, SecondSolution::finer}) {
    const BedSettings second = second_scene(rough, which).bed;
    const HeightField second_start(averaged(start.grid(), second.rows, second.cols), second.cell_size());
    expect_richardson(rough, {}, which, start, second_start);
  }
}

TEST(ErrorEstimate, CountsAllSandThatOnlyOneSolutionMoved) {
  // A flat bed, on which nothing moves: four cells that the run is said to have raised, one of the coarser
  // bed's, and eight of them that it lowered, two of the coarser bed's.
  Scene scene;
  scene.bed.width = 6.0;
  scene.bed.cols = 600;
  scene.bed.depth = 2.0;
  scene.bed.rows = 200;
  const HeightField start = starting_bed(scene.bed);
  for (const auto& [row, col] : {std::pair{0, 0}, {6, 500}, {150, 40}, {198, 596}}) {
    HeightField raised = start;
    for (int i = 0; i < 2; ++i)
      for (int j = 0; j < 4; ++j) raised.set(row + i, col + j, j < 2 ? 0.5 : -0.25);
    RunResult at_rest;
    const Solution run{raised, at_rest};
    const ErrorEstimate coarser =
        estimate_error(scene, start, {}, run, Kept(force_of), SecondSolution::coarser);
    EXPECT_DOUBLE_EQ(coarser.height_max, 0.5);
    EXPECT_DOUBLE_EQ(coarser.height_share, 1.0);
    EXPECT_DOUBLE_EQ(coarser.height_rms, std::sqrt(0.5 * (0.25 + 0.0625)));
    const ErrorEstimate finer = estimate_error(scene, start, {}, run, Kept(force_of), SecondSolution::finer);
    EXPECT_DOUBLE_EQ(finer.height_max, 1.0);
    EXPECT_DOUBLE_EQ(finer.height_share, 2.0);
  }
}

TEST(ErrorEstimate, SaysWhereOneOfBothIsNotAtRest) {
  for (const auto& [passes, at_rest] : {std::pair<std::int64_t, bool>{0, false}, {1'000'000, true}}) {
    Scene scene = cylinder_scene(16);
    const FeltRun run(scene);
    scene.relaxation.max_passes = passes;  // of the second solution alone
    EXPECT_EQ(estimated(scene, run, {}, SecondSolution::coarser).at_rest, at_rest);
    Solution restless = run.solution;
    restless.result.relaxation.converged = false;
    EXPECT_FALSE(
        estimate_error(scene, starting_bed(scene.bed), {}, restless, Kept(force_of), SecondSolution::coarser)
            .at_rest);
  }
}

TEST(ErrorEstimate, IsTheSameWhereIdleTicksAreLeftOut) {
  const Scene scene = bed_of_two_drags();
  const auto estimate = [&](Pause pause) {
    const Stroke stroke = two_drags(1.5, pause);
    return estimated(scene, FeltRun(scene, stroke), stroke, SecondSolution::coarser);
  };
  const ErrorEstimate idle = estimate(Pause::unsampled), all = estimate(Pause::sampled);
  EXPECT_GT(all.force_rms, 0.0);
  EXPECT_EQ(idle.force_rms, all.force_rms);
  EXPECT_EQ(idle.force_max, all.force_max);
  EXPECT_EQ(idle.height_rms, all.height_rms);
}

}  // namespace
}  // namespace sandstroke
