// The meaning of RelaxationOutcome::moved_volume: each volume of sand counts as often as it goes from cell to
// cell.
#include <gtest/gtest.h>

#include <cmath>

#include "sand/all_laws.h"
#include "sand/relaxation.h"

namespace sandstroke {
namespace {

constexpr double line_cell = 0.01;

/// Moved volume [m^3] in a line of cells where sand goes through each face in one direction only: what lies
/// beyond a face more than before went through it.
double through_faces(const HeightGrid& before, const HeightGrid& after) {
  double beyond = 0.0, volume = 0.0;
  for (Eigen::Index i = 0; i < before.size(); ++i) {
    beyond += after(i) - before(i);
    volume += std::abs(beyond);
  }
  return volume * line_cell * line_cell;
}

/// A block of twice `half_width` cells of this height [cells] among 100, along a row or down a column.
HeightGrid block_of_sand(bool along_row, int half_width, double height) {
  HeightGrid heights = HeightGrid::Zero(along_row ? 1 : 100, along_row ? 100 : 1);
  for (int i = 50 - half_width; i < 50 + half_width; ++i) heights(i) = height * line_cell;
  return heights;
}

RelaxationSettings settings(RelaxationLaw law, RelaxationMethod method) {
  RelaxationSettings settings;
  settings.law = law;
  settings.method = method;
  return settings;
}

constexpr RelaxationMethod methods[] = {RelaxationMethod::passes, RelaxationMethod::rkl};

TEST(MovedVolume, IsWhatWentThroughTheFacesWhateverLawAndMethod) {
  for (const RelaxationLaw law : all_laws)
    for (const RelaxationMethod method : methods)
      for (const bool along_row : {true, false})
        for (const std::int64_t most : {std::int64_t{1}, std::int64_t{7}, std::int64_t{100'000}}) {
          const HeightGrid before = block_of_sand(along_row, 10, 20.0);
          HeightField bed(before, line_cell);
          RelaxationSettings relaxation = settings(law, method);
          relaxation.max_passes = most;
          const RelaxationOutcome outcome = make_relaxer(relaxation, line_cell)->relax(bed);
          EXPECT_EQ(outcome.converged, most > 7);
          const double volume = through_faces(before, bed.grid());
          EXPECT_GT(volume, 0.0);
          EXPECT_NEAR(outcome.moved_volume, volume, 1e-9 * volume) << most;
        }
}

TEST(MovedVolume, IsThatOfTheTriangleOfACollapsedBlock) {
  // The centre of each half goes from w / 2 to L / 3, with L^2 tan(talus) = 2 w h.
  constexpr double w = 10.0, h = 20.0, volume = 2.0 * w * h;  // cells
  const double L = std::sqrt(volume / talus_slope(30.0));
  const double moved = volume * (L / 3.0 - w / 2.0) * line_cell * line_cell * line_cell;
  for (const RelaxationLaw law : all_laws)
    for (const RelaxationMethod method : methods) {
      HeightField bed(block_of_sand(true, 10, h), line_cell);
      EXPECT_NEAR(make_relaxer(settings(law, method), line_cell)->relax(bed).moved_volume, moved,
                  0.01 * moved);
    }
}

TEST(MovedVolume, IsThatOfTheMirrorImageOfASteadyFlow) {
  // A ramp whose inner cells pass on what they take: which of them count does not go by columns.
  for (const RelaxationLaw law : all_laws)
    for (const std::int64_t passes : {1, 5, 30}) {
      HeightGrid ramp(3, 203);
      for (int col = 0; col < 203; ++col) ramp.col(col) = col;
      HeightField east(ramp, 1.0), west(HeightGrid(ramp.rowwise().reverse()), 1.0);
      RelaxationSettings relaxation = settings(law, RelaxationMethod::passes);
      relaxation.max_passes = passes;
      const double moved = make_relaxer(relaxation, 1.0)->relax(east).moved_volume;
      EXPECT_NEAR(make_relaxer(relaxation, 1.0)->relax(west).moved_volume, moved, 1e-12 * moved) << passes;
    }
}

TEST(RelaxationOutcome, CountsOneAfterAnotherAndRestsAsTheLast) {
  RelaxationOutcome first, next;
  first.passes = 1;
  first.super_steps = 2;
  first.rejected_stages = 3;
  first.cells_visited = 4;
  first.wake_ups = 5;
  first.tiles_active_max = 6;
  first.moved_volume = 7.0;
  first.residual = 8.0;
  first.converged = true;
  next.passes = 10;
  next.super_steps = 20;
  next.rejected_stages = 30;
  next.cells_visited = 40;
  next.wake_ups = 50;
  next.tiles_active_max = 5;
  next.moved_volume = 70.0;
  next.residual = 0.5;
  first.add(next);
  EXPECT_EQ(first.passes, 11);
  EXPECT_EQ(first.super_steps, 22);
  EXPECT_EQ(first.rejected_stages, 33);
  EXPECT_EQ(first.cells_visited, 44);
  EXPECT_EQ(first.wake_ups, 55);
  EXPECT_EQ(first.tiles_active_max, 6);
  EXPECT_EQ(first.moved_volume, 77.0);
  EXPECT_EQ(first.residual, 0.5);
  EXPECT_FALSE(first.converged);
}

}  // namespace
}  // namespace sandstroke
