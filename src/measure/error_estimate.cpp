#include "measure/error_estimate.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/error.h"
#include "core/stopwatch.h"
#include "sand/cell_means.h"

namespace sandstroke {
namespace {

/// Sums over differences of heights (times area) or forces (per tick).
struct Distance {
  double sum = 0.0, squares = 0.0, max = 0.0;
  void add(double difference, double weight) {
    sum += weight * difference;
    squares += weight * difference * difference;
    max = std::max(max, difference);
  }
};

/// each: a field of the coarser bed's cells; if given, it gets the distance in each cell.
Distance height_distance(const HeightField& fine, const HeightField& coarse, HeightField* each) {
  Distance distance;
  const CellMeans means(fine, coarse.rows(), coarse.cols());
  for (const int tile : touched_tiles(fine, coarse)) {
    const CellRange cells = coarse.tile_cells(tile);
    for (int row = cells.row_begin; row < cells.row_end; ++row)
      for (int col = cells.col_begin; col < cells.col_end; ++col) {
        const double apart = std::abs(means(row, col) - coarse(row, col));
        distance.add(apart, coarse.cell_area());
        if (each) each->set(row, col, apart);
      }
  }
  return distance;
}

/// Compares the ticks that both have: every second one of `fine` is one of `coarse`, to the bit of its time.
Distance force_distance(const Kept<Eigen::Vector3d>& fine, const Kept<Eigen::Vector3d>& coarse) {
  Distance distance;
  std::size_t i = 0;
  for (std::size_t k = 0; k < coarse.values.size(); ++k) {
    while (i < fine.times.size() && fine.times[i] < coarse.times[k]) ++i;
    if (i < fine.times.size() && fine.times[i] == coarse.times[k])
      distance.add((coarse.values[k] - fine.values[i]).norm(), 1.0);
  }
  return distance;
}

/// The second solution's start. If no rule can make its cells anew, they are averaged, or split.
HeightField heights_of(const Scene& second, const HeightField& start) {
  const SurfaceSettings& surface = second.bed.surface;
  const bool cell_by_cell =
      surface.kind == SurfaceKind::file || (surface.kind == SurfaceKind::noise && surface.wavelength == 0.0);
  const int rows = second.bed.rows, cols = second.bed.cols;
  if (!cell_by_cell) return starting_bed(second.bed);
  const CellMeans means(start, rows, cols);
  return HeightField(HeightGrid::NullaryExpr(rows, cols, means), second.bed.cell_size(), second.bed.shape);
}

HeightField start_of(const Scene& second, const HeightField& start) {
  return on_ground(heights_of(second, start), second);
}

/// The sand that is not where it was: volume, and area of the changed cells.
struct Change {
  double volume = 0.0, area = 0.0;  // m^3, m^2
};
Change change_of(const HeightField& start, const HeightField& end) {
  Change change;
  for (int slot = 0; slot < end.allocated_tiles(); ++slot) {
    const CellRange cells = end.tile_cells(end.tile_of(slot));
    for (int row = cells.row_begin; row < cells.row_end; ++row)
      for (int col = cells.col_begin; col < cells.col_end; ++col) {
        const double difference = std::abs(end(row, col) - start(row, col));
        change.volume += difference * end.cell_area();
        change.area += difference > 0.0 ? end.cell_area() : 0.0;
      }
  }
  return change;
}

}  // namespace

Scene second_scene(const Scene& scene, SecondSolution which) {
  const bool coarser = which == SecondSolution::coarser;
  const double factor = coarser ? 2.0 : 0.5;
  const int units = std::gcd(scene.bed.rows, scene.bed.cols),
            units_then = coarser ? (units + 1) / 2 : 2 * units;
  if (units_then == units)
    throw_input_error(
        "the error cannot be estimated: larger square cells than those of bed.cells = [{}, {}] do not fill "
        "the bed; take even numbers of cells, or the finer solution",
        scene.bed.cols, scene.bed.rows);
  const DeviceSettings& device = scene.device;
  if (device.dropped_ticks > 0.0)
    throw_input_error(
        "the error cannot be estimated: device.dropped_ticks = {} is a fraction of ticks, and the second "
        "solution has ticks of another length; set it to 0",
        device.dropped_ticks);
  if (coarser && device.delay % 2 != 0)
    throw_input_error(
        "the error cannot be estimated: device.delay = {} ticks is odd, and the coarser solution has ticks "
        "twice as long; take an even delay, or the finer solution",
        device.delay);
  Scene second = scene;
  second.device.delay = coarser ? device.delay / 2 : 2 * device.delay;  // the same delay in time
  second.bed.rows = scene.bed.rows / units * units_then;
  second.bed.cols = scene.bed.cols / units * units_then;
  second.device.servo_rate /= factor;
  second.relaxation.rate /= factor;
  second.relaxation.way *= factor;
  second.relaxation.way_at_rim *= factor;
  second.relaxation.tolerance *= factor;
  second.relaxation.step_tolerance *= factor;
  second.output.frames = 0.0;
  check_scene(second, coarser ? "the coarser solution for the error estimate"
                              : "the finer solution for the error estimate");
  return second;
}

ErrorEstimate estimate_error(const Scene& scene, const HeightField& start,
                             const std::optional<Stroke>& stroke, const Solution& run,
                             const Kept<Eigen::Vector3d>& force, SecondSolution which, HeightField* map) {
  const Stopwatch watch;
  const Scene second_settings = second_scene(scene, which);
  Kept second_force(force_of);
  const Solution second = solve(second_settings, start_of(second_settings, start), stroke, {&second_force});
  const bool coarser = which == SecondSolution::coarser;
  const Solution &coarse = coarser ? second : run, &fine = coarser ? run : second;
  const Kept<Eigen::Vector3d>&coarse_force = coarser ? second_force : force,
        &fine_force = coarser ? force : second_force;

  // Errors e(run) = C and e(coarser) = r C, or e(run) = r C and e(finer) = C; the distance is (r - 1) C.
  const auto error_over_distance = [&](double r) { return (coarser ? 1.0 : r) / (r - 1.0); };
  const double height_factor = error_over_distance(coarse.surface.cell_size() / fine.surface.cell_size()),
               force_factor = error_over_distance(2.0);
  std::optional<HeightField> distances;  // the heights', in the cells of the coarser bed
  if (map) distances.emplace(coarse.surface.rows(), coarse.surface.cols(), coarse.surface.cell_size());
  const Distance of_height = height_distance(fine.surface, coarse.surface, distances ? &*distances : nullptr),
                 of_force = force_distance(fine_force, coarse_force);
  if (map) take_means(*distances, *map, height_factor);
  const Change change = change_of(start, run.surface);
  const auto forces = std::count_if(coarse_force.values.begin(), coarse_force.values.end(),
                                    [](const Eigen::Vector3d& f) { return f.squaredNorm() > 0.0; });
  ErrorEstimate estimate;
  if (change.volume > 0.0) {
    estimate.height_share = height_factor * of_height.sum / change.volume;
    estimate.height_rms = height_factor * std::sqrt(of_height.squares / change.area);
  }
  estimate.height_max = height_factor * of_height.max;
  if (forces > 0)
    estimate.force_rms = force_factor * std::sqrt(of_force.squares / static_cast<double>(forces));
  estimate.force_max = force_factor * of_force.max;
  estimate.at_rest = run.result.relaxation.converged && second.result.relaxation.converged;
  estimate.wall_seconds = watch.seconds();
  return estimate;
}

}  // namespace sandstroke
